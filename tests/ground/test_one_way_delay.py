"""The age of a message includes its delay in transit."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from up_ground.one_way_delay import DRIFT, NEW_CLOCK_S, OneWayDelayEstimator

ROUNDING_S = 0.001
PPM_S = 1e-6
LEAST_S = 0.08


def journey(steps, drift=0.0, apart_s=5000.0, rounding_ms=3):
    """Yield (stamp_ms, came_s, held_s) of messages in order, as a link delivers them.

    ``steps`` are (seconds since the message before, seconds of delay in addition to the transit).
    """
    sent_s, came_s = 0.0, 0.0
    for after_s, wait_s in steps:
        sent_s += after_s
        came_s = max(came_s, sent_s + LEAST_S + wait_s)
        stamp_ms = round((sent_s * (1 + drift) + apart_s) * 1000, rounding_ms)
        yield stamp_ms, came_s, came_s - sent_s - LEAST_S


STEPS = st.lists(
    st.tuples(st.floats(0.02, 20.0), st.one_of(st.just(0.0), st.floats(0.0, 20.0))),
    min_size=1,
    max_size=80,
)


@settings(deadline=None)
@given(STEPS, st.floats(-DRIFT, DRIFT), st.floats(-1e5, 1e5), st.integers(0, 3))
def test_what_is_told_is_never_too_much_and_too_little_by_no_more_than_the_drift(
    steps, drift, apart_s, digits
):
    delay = OneWayDelayEstimator()
    quickest_s = float("inf")
    for stamp_ms, came_s, held_s in journey(steps, drift, apart_s + 2e5, digits):
        told_s = delay.update(stamp_ms, came_s)
        quickest_s = min(quickest_s, held_s)
        assert 0 <= told_s <= held_s - quickest_s + ROUNDING_S + 1e-6
        assert told_s >= held_s - quickest_s - 2 * DRIFT * (came_s + 20) - ROUNDING_S


@settings(deadline=None)
@given(STEPS)
def test_with_clocks_that_agree_it_is_exact_to_the_drift_that_is_allowed(steps):
    delay = OneWayDelayEstimator()
    assert delay.update(5e6, LEAST_S) == 0
    for stamp_ms, came_s, held_s in journey(steps):
        told_s = delay.update(stamp_ms, came_s)
        assert held_s - DRIFT * came_s - ROUNDING_S <= told_s <= held_s + ROUNDING_S


def test_a_queue_that_stands_for_an_hour_is_not_taken_for_the_way():
    delay = OneWayDelayEstimator()
    delay.update(0, 0.0)
    for second in range(1, 3601):
        told_s = delay.update(second * 1000, second + min(second / 10, 3.0))
    assert told_s == pytest.approx(3.0, abs=0.37)
    assert delay.update(3601_000, 3601.0) < ROUNDING_S


@pytest.mark.parametrize("ppm", [-100, -20, 20, 100])
def test_hours_of_drift_make_nothing_old(ppm):
    delay = OneWayDelayEstimator()
    for second in range(20_000):
        assert 0 <= delay.update(second * 1000 * (1 + ppm * PPM_S), float(second)) < ROUNDING_S


def test_a_clock_that_began_anew_is_another_clock():
    delay = OneWayDelayEstimator()
    delay.update(12_000, 10.0)
    assert delay.update(13_000, 14.0) == pytest.approx(3.0, abs=0.01)
    assert delay.update(4_000, 20.0) == 0
    assert delay.has_begun
    assert delay.update(5_000, 21.2) == pytest.approx(0.2, abs=0.01)
    assert not delay.has_begun


def test_a_clock_that_fell_far_behind_is_another_clock():
    delay = OneWayDelayEstimator()
    delay.update(40_000, 10.0)
    assert delay.update(41_000, 12.0 + NEW_CLOCK_S) == 0
    assert delay.update(42_000, 13.0 + NEW_CLOCK_S) == pytest.approx(0, abs=0.01)


def test_a_queue_that_grows_beyond_that_is_a_queue():
    delay = OneWayDelayEstimator()
    for second in range(100):
        told_s = delay.update(second * 500, float(second))
    assert told_s == pytest.approx(49.5, abs=0.02)


def test_a_clock_that_leaps_ahead_and_back_heals():
    delay = OneWayDelayEstimator()
    delay.update(1_000, 1.0)
    assert delay.update(9e9, 2.0) == 0
    assert delay.update(3_000, 3.0) == 0
    assert delay.update(4_000, 5.0) == pytest.approx(1.0, abs=0.01)


def test_a_message_without_a_stamp_is_not_judged_and_changes_nothing():
    delay = OneWayDelayEstimator()
    assert delay.update(None, 1.0) is None
    delay.update(1_000, 2.0)
    assert delay.update(None, 90.0) is None
    assert delay.update(2_000, 3.5) == pytest.approx(0.5, abs=0.01)


def test_what_was_known_can_be_forgotten():
    delay = OneWayDelayEstimator()
    delay.update(1_000, 1.0)
    delay.reset()
    assert delay.update(2_000, 5.0) == 0


@settings(deadline=None)
@given(st.lists(st.tuples(st.floats(-1e12, 1e12), st.floats(0, 1e6)), max_size=30))
def test_no_stamps_break_it(messages):
    delay = OneWayDelayEstimator()
    for stamp_ms, now_s in sorted(messages, key=lambda each: each[1]):
        assert delay.update(stamp_ms, now_s) >= 0


def trusted(from_s=100.0, to_s=100.2):
    """A clock that was 5 s behind when it was read."""
    delay = OneWayDelayEstimator()
    delay.trust(95_100, from_s, to_s)
    return delay


def test_a_compared_clock_shows_a_delay_that_every_message_has():
    delay = trusted()
    assert delay.update(96_000, 104.0) == pytest.approx(3.0, abs=0.001)
    # Neither a long pause nor a step back makes it a new clock.
    assert delay.update(97_000, 97.0 + 5 + 3 + NEW_CLOCK_S + 1) > NEW_CLOCK_S
    delay.reset()
    assert delay.update(97_000 - 1, 140.0) > NEW_CLOCK_S


def test_the_error_of_a_comparison_is_at_most_half_of_its_round_trip():
    delay = trusted(100.0, 102.0)
    # Read at the last moment: 1 s too little; at the first: 1 s too much.
    assert delay.update(95_200, 95.2 + 6.9) == pytest.approx(1.0, abs=0.01)
    assert trusted(100.0, 102.0).update(95_200, 95.2 + 4.9) == 0.0


def test_a_slow_comparison_keeps_what_a_quick_one_found():
    delay = trusted()
    delay.trust(105_000, 110.0 - 0.9, 110.0 + 1.0)
    assert delay.update(106_000, 111.0) == pytest.approx(0.0, abs=0.1)


def test_a_comparison_with_another_life_begins_anew():
    delay = trusted()
    delay.trust(1_000, 200.0, 200.2)
    assert delay.update(2_000, 201.1) == pytest.approx(0.0, abs=0.01)
