"""An aircraft that crashes flies again, and its battery never ends a flight."""

import pytest
from twisted.internet.task import Clock

from up_rig.pty_line import PtyLine
from up_rig.sticks import read_sticks
from up_simulator.aircraft import FlightDynamics, Start, load_airframe
from up_simulator.firmware.direct_board import DirectBoard
from up_simulator.harness.firmware_aircraft import BATTERY_LEAST_PERCENT, FirmwareAircraft
from up_simulator.radio.scripted import ScriptedRadio

DIVES = "t=0 elevator=1350 throttle=1000"


class Flown:
    """Sticks straight to the servos: nothing saves this aircraft."""

    def __init__(self, script, **start):
        self.clock, self.said, self.line = Clock(), [], PtyLine()
        self.flight = FlightDynamics(load_airframe("glider"), Start(**start))
        radio = ScriptedRadio(read_sticks(script))
        self.aircraft = FirmwareAircraft(
            self.flight, DirectBoard(), self.line, radio, self.clock, "script", self.said.append,
            lambda: "ACRO, a script had the sticks",
        )  # fmt: skip

    def run(self, seconds, until=lambda: False):
        for _ in range(round(seconds / 0.02)):
            self.clock.advance(0.02)
            self.aircraft.keep()
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


def test_a_crash_is_said_and_it_flies_again(fly):
    flown = fly(DIVES, height_m=30.0)
    flown.run(20.0, until=lambda: flown.said)
    assert "hit the ground after" in flown.said[0] and "in 3 s it flies again" in flown.said[0]
    flown.run(2.5)
    assert flown.flight.crash is not None and len(flown.said) == 1
    flown.run(1.0)
    why = "(ACRO, a script had the sticks)"
    assert why in flown.said[0]
    assert flown.said[1] == f"launched again in the air, after the crash {why}"
    assert flown.flight.crash is None
    assert flown.flight.state.height_m > 100


def test_an_empty_battery_is_changed_and_said(fly):
    flown = fly("t=0 throttle=2000 elevator=1700")
    flown.flight._battery._left_c *= BATTERY_LEAST_PERCENT / 100 * 1.001
    flown.run(10.0, until=lambda: flown.said)
    assert flown.said == ["the battery is empty after 0 min: changed in flight"]
    flown.run(0.1)
    assert flown.flight.state.battery_percent > 95
