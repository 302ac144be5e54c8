"""The airspeed that fixes have measured, on its way to the board's attitude."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest
from arduino_cog.modules.arduino_airspeed import payload_of
from arduino_cog.wire import pack_airspeed
from hypothesis import given
from hypothesis import strategies as st

from raspilot.modules.navigation_estimator import NavigationEstimator
from tests.raspilot.navigation.point_mass import PointMass
from up.commands.location_command import LocationCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.roles import Role

BOARD = Origin("arduino", Role.BOARD, 10)
PHONE = Origin("android", Role.SENSOR, 5)
AIRSPEED_M_S, WIND_NORTH_M_S, TURN_DEG_S = 11.0, 3.0, 24.0
STEP_S = 0.02
M_PER_DEG = 111_195.0
STATE = replace(PointMass().state, measured_airspeed_m_s=12.34, wind_sd_m_s=1.0)


class Circling:
    """An aircraft that circles in the wind, and its reports to a rig."""

    def __init__(self, rig):
        self.rig = rig
        self.steps = 0
        self.north_m = self.east_m = 0.0

    def fly(self, seconds, fixes=True):
        """Return the payloads of `A`, each with the step in which it was sent."""
        sent = []
        for _ in range(round(seconds / STEP_S)):
            self.steps += 1
            yaw_deg = (TURN_DEG_S * self.steps * STEP_S) % 360.0
            north = AIRSPEED_M_S * math.cos(math.radians(yaw_deg)) + WIND_NORTH_M_S
            east = AIRSPEED_M_S * math.sin(math.radians(yaw_deg))
            self.north_m += north * STEP_S
            self.east_m += east * STEP_S
            self.rig.advance(STEP_S)
            self.rig.publish(OrientationCommand(25.0, 2.0, yaw_deg), origin=BOARD)
            if fixes and self.steps % 50 == 0:
                self.rig.publish(self._fix(north, east), origin=PHONE)
            sent += [(self.steps, each) for each in self.rig.sent("A")]
            self.rig.forget()
        return sent

    def _fix(self, north, east):
        return LocationCommand(
            50.0 + self.north_m / M_PER_DEG,
            14.5 + self.east_m / (M_PER_DEG * math.cos(math.radians(50.0))),
            300.0,
            accuracy_m=3.0,
            speed_m_s=math.hypot(north, east),
            bearing_deg=math.degrees(math.atan2(east, north)) % 360.0,
            age_ms=0,
        )


def test_it_is_sent_five_times_a_second_while_fixes_measure_it(make_rig):
    rig = make_rig(modules=[NavigationEstimator])
    rig.connect()
    circling = Circling(rig)
    assert circling.fly(1.5) == [], "the wind is unknown"
    circling.fly(28.5)
    sent = circling.fly(4)
    assert 18 <= len(sent) <= 20
    assert min(b - a for (a, _), (b, _) in pairwise(sent)) >= 10
    for _, payload in sent:
        assert int.from_bytes(payload) / 100 == pytest.approx(AIRSPEED_M_S, abs=0.7)
    assert circling.fly(3, fixes=False), "the last fix is young"
    assert circling.fly(3, fixes=False) == []


def test_it_is_never_sent_in_thesis_framing(make_rig):
    rig = make_rig("thesis", modules=[NavigationEstimator])
    rig.start()
    rig.say("o", b"\0" * 12)
    assert Circling(rig).fly(12) == []
    assert rig.module(NavigationEstimator).state.measured_airspeed_m_s is not None


def test_an_airspeed_without_a_known_wind_is_kept_back():
    assert payload_of(STATE) == bytes.fromhex("04d2")
    assert payload_of(replace(STATE, wind_sd_m_s=2.1)) is None
    assert payload_of(replace(STATE, measured_airspeed_m_s=None)) is None


@given(st.floats())
def test_only_what_the_board_takes_is_packed(airspeed_m_s):
    payload = pack_airspeed(airspeed_m_s)
    assert (payload is not None) == (5 <= airspeed_m_s <= 40)
    assert payload is None or 500 <= int.from_bytes(payload) <= 4000
