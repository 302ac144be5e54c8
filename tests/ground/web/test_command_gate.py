"""Which beacons of a page's Commands count as seen, by a clock of the test's own."""

import pytest
from twisted.internet.task import Clock

from up.protocols.general_message import GeneralMessage
from up_ground.telemetry import Telemetry
from up_ground.web.command_gate import KEPT, RecentBeacons

NAME = "up.flight_mode.set"


class Desk:
    def __init__(self):
        self.clock, self.telemetry = Clock(), Telemetry()
        self.recent = RecentBeacons(self.clock, self.telemetry)

    def frame(self, beacon, **system):
        message = GeneralMessage("up.telemetry.update", {"system": system}, None, beacon)
        self.telemetry.update(message, self.clock.seconds())
        self.recent.poll()

    def code(self, beacon):
        fault = self.recent.fault(NAME, beacon)
        return fault and fault[0]


@pytest.fixture
def desk():
    return Desk()


def test_before_the_first_frame_nothing_counts(desk):
    assert desk.code(None) == "no_beacon"
    assert desk.code(0) == "stale"


def test_a_beacon_counts_for_two_seconds(desk):
    desk.frame(100)
    desk.clock.advance(1.0)
    desk.frame(101)
    for _ in range(50):
        # Time passes without a frame: a second look is not a new frame.
        desk.recent.poll()
    codes = [desk.code(each) for each in (99, 100, 101, 102)]
    assert codes == ["stale", None, None, "unknown_beacon"]
    desk.clock.advance(1.0)
    assert desk.code(100) is None
    desk.clock.advance(0.1)
    assert [desk.code(each) for each in (100, 101)] == ["stale", None]
    desk.clock.advance(1.0)
    assert desk.code(101) == "stale"
    assert desk.code(None) == "no_beacon"


def test_a_beacon_counts_for_a_slow_period_and_its_way(desk):
    desk.frame(100, period_ms=10_000)
    desk.clock.advance(11.0)
    assert desk.code(100) is None
    desk.clock.advance(0.1)
    assert desk.code(100) == "stale"
    desk.frame(101, period_ms=100)
    desk.clock.advance(2.1)
    assert desk.code(101) == "stale"


def test_an_aircraft_without_beacons_takes_commands_without_one(desk):
    desk.frame(None)
    assert desk.code(None) is None
    assert desk.code(5) == "stale"
    desk.frame(5)
    assert desk.code(5) is None
    desk.frame(None)
    assert desk.code(None) == "no_beacon"


def test_a_flood_of_frames_costs_no_memory(desk):
    for beacon in range(10 * KEPT):
        desk.frame(beacon)
    assert desk.code(10 * KEPT - 1) is None
    assert desk.code(9 * KEPT - 1) == "stale"
