"""A crashed aircraft is relaunched, and an empty battery is changed."""

import pytest
from twisted.internet.task import Clock

from up_rig.pty_line import PtyLine
from up_rig.sticks import read_sticks
from up_simulator.aircraft import FlightDynamics, Start, load_airframe
from up_simulator.firmware.direct_board import DirectBoard
from up_simulator.harness.firmware_aircraft import (
    LANDED_DELAY_S,
    MIN_BATTERY_PERCENT,
    FirmwareAircraft,
)
from up_simulator.harness.world import World
from up_simulator.radio.choice import ScriptedRadio

DIVES = "t=0 elevator=1350 throttle=1000"


class Flown:
    """Sticks straight to the servos: nothing saves this aircraft."""

    def __init__(self, script, **start):
        self.clock, self.logged, self.line = Clock(), [], PtyLine()
        self.flight = FlightDynamics(load_airframe("glider"), Start(**start), may_land=True)
        radio = ScriptedRadio(read_sticks(script))
        world = World(self.flight, DirectBoard())
        self.aircraft = FirmwareAircraft(
            self.flight, world, self.line, radio, self.clock, "script", self.log,
            lambda: "ACRO, a script had the sticks",
        )  # fmt: skip

    def log(self, _text, /, *, code="", **fields):
        self.logged.append((code, fields))

    def run(self, seconds, until=lambda: False):
        for _ in range(round(seconds / 0.02)):
            self.clock.advance(0.02)
            self.aircraft.advance()
            if until():
                return


@pytest.fixture
def fly():
    made = []

    def make(*arguments, **start):
        made.append(Flown(*arguments, **start))
        return made[-1]

    yield make
    for each in made:
        each.line.close()


def test_a_crashed_aircraft_is_relaunched(fly):
    flown = fly(DIVES, height_m=30.0)
    flown.run(20.0, until=lambda: flown.logged)
    assert flown.logged == [("crashed", {"crash": flown.flight.crash})]
    flown.run(2.5)
    assert flown.flight.crash is not None and len(flown.logged) == 1
    flown.run(1.0)
    assert flown.logged[1][0] == "relaunched"
    assert flown.flight.crash is None
    assert flown.flight.state.height_m > 100


def test_a_landed_aircraft_stands_before_the_flight_begins_again(fly):
    flown = fly("t=0 throttle=1000", height_m=1.0)
    flown.run(10.0, until=lambda: flown.logged)
    ((code, fields),) = flown.logged
    assert (code, flown.flight.crash) == ("landed", None)
    assert 5.0 < fields["distance_m"] < 100.0
    flown.run(LANDED_DELAY_S - 0.5)
    assert len(flown.logged) == 1
    assert (flown.flight.state.height_m, flown.flight.state.speed_m_s) == (
        pytest.approx(0, abs=0.2),
        0,
    )
    flown.run(1.0)
    assert [each for each, _ in flown.logged] == ["landed", "relaunched"]
    assert flown.flight.state.height_m > 100


def test_an_empty_battery_is_changed(fly):
    flown = fly("t=0 throttle=2000 elevator=1700")
    flown.flight._battery._left_c *= MIN_BATTERY_PERCENT / 100 * 1.001
    flown.run(10.0, until=lambda: flown.logged)
    assert flown.logged == [("battery_changed", {})]
    flown.run(0.1)
    assert flown.flight.state.battery_percent > 95
