"""How old telemetry is when it comes, by the uptime and for frames that were waiting."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.protocols.general_message import GeneralMessage
from up_simulator.in_process.ground import UptimeAges

PERIOD_S = 0.1
LINK_S = 0.05


def frame(beacon, uptime_s):
    return GeneralMessage("up.telemetry.update", {"system": {"uptime_s": uptime_s}}, None, beacon)


class Daemon:
    """Makes frames as the real one, the first of a life at ``began_s``."""

    def __init__(self, began_s, beacon):
        self._began_s = began_s
        self._beacon = beacon

    def frame(self, made_s):
        uptime_s = made_s - self._began_s
        return frame(self._beacon + round(uptime_s / PERIOD_S), round(uptime_s))


@pytest.fixture
def ages():
    return UptimeAges()


def hear(ages, daemon, from_s, to_s):
    """Let the frames come that are made in this time."""
    count = round((to_s - from_s) / PERIOD_S)
    made_s = [from_s + at * PERIOD_S for at in range(count)]
    return [ages.age_s(daemon.frame(each), each + LINK_S) for each in made_s]


def test_a_fresh_frame_is_told_at_most_a_second_too_old(ages):
    told = hear(ages, Daemon(1000.3, 5000), 1000.4, 1020)
    assert min(told) >= 0 and max(told) <= 1.0


@given(st.floats(0, 60), st.floats(0, 0.999))
def test_no_age_is_told_too_small(age_s, made_after_s):
    ages, daemon = UptimeAges(), Daemon(1000.3, 5000)
    hear(ages, daemon, 1000.4, 1003)
    made_s = 1003.0 + made_after_s
    told = ages.age_s(daemon.frame(made_s), made_s + age_s)
    assert age_s - LINK_S - PERIOD_S - 1e-6 <= told <= age_s + 1.0 + 1e-6


def test_a_backlog_is_old_and_so_is_one_of_the_life_before(ages):
    first, second = Daemon(1000.0, 700), Daemon(1010.0, 90_000_000)
    hear(ages, first, 1001, 1005)
    assert ages.age_s(first.frame(1005.2), 1035.0) > 29
    assert max(hear(ages, second, 1035, 1038)) <= 1.0
    assert ages.age_s(first.frame(1009.0), 1038.0) > 28
    assert max(hear(ages, second, 1038, 1040)) <= 1.0


@pytest.mark.parametrize(
    ("beacon", "data"),
    [(None, {"system": {"uptime_s": 3}}), (1, {}), (1, {"system": 3}), (1, {"system": {}}),
     (1, {"system": {"uptime_s": "3"}}), (1, {"system": {"uptime_s": True}})],
)  # fmt: skip
def test_what_tells_no_time_has_no_age(ages, beacon, data):
    message = GeneralMessage("up.telemetry.update", data, None, beacon)
    assert ages.age_s(message, 1000.0) is None
