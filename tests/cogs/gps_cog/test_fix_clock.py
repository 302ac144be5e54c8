"""The age of a fix on arrival, from the receiver's clock and the arrivals."""

import pytest
from gps_cog.fix_clock import LATE_S, NEW_CLOCK_FIXES, FixClock
from hypothesis import given
from hypothesis import strategies as st


def ages(clock, arrivals):
    return [clock.age_s(stamp_s, now_s) for stamp_s, now_s in arrivals]


def test_the_quickest_fix_has_the_least_delay_and_others_are_older():
    late_s = [0.0, 0.05, 0.0, 0.2, 0.01]
    found = ages(FixClock(0.1), [(n / 10, 7.0 + n / 10 + late_s[n]) for n in range(5)])
    assert found == pytest.approx([0.1 + each for each in late_s], abs=1e-3)


def test_a_late_first_fix_is_corrected_by_the_first_quick_one():
    clock = FixClock(0.1)
    assert ages(clock, [(0.0, 5.2), (0.1, 5.1)]) == [0.1, 0.1]
    assert clock.age_s(0.2, 5.4) == pytest.approx(0.3, abs=1e-3)


def test_a_stamp_that_does_not_follow_is_rejected_and_moves_nothing():
    clock = FixClock(0.1)
    arrivals = [(0.0, 0.0), (0.1, 0.1), (0.1, 0.15), (-3.0, 0.2), (9.0, 0.3), (0.3, 0.3)]
    expected = [0.1, 0.1, "repeated", "past", "future", pytest.approx(0.1)]
    assert ages(clock, arrivals) == expected


@pytest.mark.parametrize("step_s", [18.0, -18.0, -3600.0, 1e9])
def test_a_clock_that_was_set_is_followed_after_some_fixes(step_s):
    clock = FixClock(0.1)
    ages(clock, [(n / 10, n / 10) for n in range(20)])
    found = ages(clock, [(step_s + n / 10, n / 10) for n in range(20, 30)])
    assert {type(each) for each in found[: NEW_CLOCK_FIXES - 1]} == {str}
    assert found[NEW_CLOCK_FIXES - 1 :] == pytest.approx([0.1] * (11 - NEW_CLOCK_FIXES), abs=1e-3)


def test_a_receiver_that_repeats_a_time_is_never_believed():
    clock = FixClock(0.1)
    clock.age_s(5.0, 0.0)
    assert set(ages(clock, [(5.0, n / 10) for n in range(1, 60)])) == {"repeated", "past"}


@pytest.mark.parametrize("period_s", [86400.0, 604800.0])
def test_the_end_of_day_and_week_is_no_step(period_s):
    found = ages(FixClock(0.1, period_s), [((period_s - 1 + n / 10) % period_s, n / 10)
                                           for n in range(20)])  # fmt: skip
    assert found == pytest.approx([0.1] * 20, abs=1e-3)


def test_fixes_continue_after_a_long_pause():
    found = ages(FixClock(0.1), [(0.0, 0.0), (1800.0, 1800.05), (1800.1, 1800.15)])
    assert found[0] == 0.1 and all(0.0 <= each < 0.2 for each in found[1:])


@given(st.lists(st.floats(0, LATE_S - 0.01), min_size=1, max_size=50))
def test_jitter_never_makes_a_fix_younger_than_it_is_at_the_quickest(delays):
    clock = FixClock(0.1)
    clock.age_s(0.0, 0.0)
    for number, delay_s in enumerate(delays, 1):
        age_s = clock.age_s(number * 2.0, number * 2.0 + delay_s)
        assert 0.1 <= age_s <= 0.1 + delay_s + 1e-9
        assert age_s == pytest.approx(0.1 + delay_s, abs=2e-4 * 2.0 * (number + 1))
