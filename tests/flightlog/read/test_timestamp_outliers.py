"""A damaged time neither stretches a flight nor moves its start."""

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.flightlog.logs import SECOND_NS, START_NS, LogMaker
from up_flightlog.read.timestamp_outliers import outliers

STEADY = [START_NS + number * SECOND_NS // 10 for number in range(200)]
DAMAGE = [0, 5, START_NS // 2, START_NS + 7200 * SECOND_NS, START_NS + 300 * SECOND_NS, 2**64 - 1]


@pytest.mark.parametrize("wrong_ns", DAMAGE)
@pytest.mark.parametrize("place", [0, 1, 100, 198])
def test_a_time_that_contradicts_its_neighbours_is_an_outlier(place, wrong_ns):
    times_ns = [*STEADY]
    times_ns[place] = wrong_ns
    assert list(outliers(times_ns)) == [place]


def test_the_last_message_is_compared_with_those_before():
    assert list(outliers([*STEADY, STEADY[-1] + 7200 * SECOND_NS])) == [200]
    assert list(outliers([*STEADY, STEADY[-1] + 120 * SECOND_NS])) == []


def test_a_flight_may_continue_after_a_pause():
    later = [each + 7200 * SECOND_NS for each in STEADY]
    assert list(outliers([*STEADY, *later])) == []
    # Logs of others may have one topic after the other.
    assert list(outliers([*STEADY, *later, *STEADY])) == []
    assert list(outliers([START_NS + number * 120 * SECOND_NS for number in range(50)])) == []


@given(st.lists(st.integers(0, 2**64 - 1), max_size=60))
def test_any_times(times_ns):
    found = list(outliers(times_ns))
    assert found == sorted(set(found))
    assert len(found) < max(1, len(times_ns))


def test_outliers_do_not_change_the_length_of_a_log(tmp_path):
    maker = LogMaker()
    draw = random.Random(1)
    damaged = set(draw.sample(range(600), 12))
    for number in range(600):
        time_s = number / 10
        if number in damaged:
            time_s = draw.choice([-1e9, 5e8, 9000.0, 864e5])
        maker.add(time_s, "up.altitude.change", altitude=number)
    log = maker.log(tmp_path)
    assert log.length_s == pytest.approx(59.9, abs=0.2)
    assert log.start_unix_s == pytest.approx(START_NS / SECOND_NS, abs=0.2)
    assert log.topics["up.altitude.change"] == 588 == len(list(log.messages()))
    assert [each.code for each in log.problems] == ["timestamp_outliers"]
