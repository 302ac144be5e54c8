"""Each rule of the motor watch, on fixes of an aircraft that is known exactly."""

import cmath
import math

import pytest

from raspilot.navigation.air_path import AirPoint
from raspilot.navigation.motor_watch import MotorWatch

LEVEL_M_S2 = 0.9


class Fixes:
    """A fix each second; ``lost`` is the share of the thrust that the motor does not give."""

    def __init__(self):
        self.watch = MotorWatch()
        self.time_s = 0.0
        self.speed = 11.0
        self.thrust = self.coast = self.turned_deg = self.unseen_s = 0.0
        self.wind = self.gust = 0j
        self.wind_variance = 0.04
        self.factor = 1.0

    def fly(self, seconds, *, thrust=LEVEL_M_S2, lost=0.0, turn_deg=0.0, gusts=(0.0,), step_s=1.0):
        """Return after how many fixes the verdict changed; None: it did not."""
        for count in range(1, seconds + 1):
            self.time_s += step_s
            self.thrust += thrust * step_s
            self.coast -= LEVEL_M_S2 * step_s
            self.speed += ((1.0 - lost) * thrust - LEVEL_M_S2) * step_s
            self.turned_deg += turn_deg
            nose = cmath.rect(1.0, math.radians(self.turned_deg))
            ground = (self.speed + gusts[count % len(gusts)]) * nose + self.wind + self.gust
            at = AirPoint(
                self.time_s, 0.0, 0.0, 0.0, self.thrust, self.coast, 11.0, 0.0, self.turned_deg,
                self.unseen_s,
            )  # fmt: skip
            if self.watch.fix(at, ground, nose, self.wind, self.wind_variance, self.factor):
                return count
        return None


@pytest.fixture
def fixes():
    fixes = Fixes()
    assert fixes.fly(60) is None
    return fixes


@pytest.mark.parametrize("turn_deg", [0.0, 12.6])
def test_a_stop_in_level_flight_takes_three_fixes(turn_deg):
    fixes = Fixes()
    fixes.wind = 6 + 0j
    assert fixes.fly(60, turn_deg=turn_deg) is None
    assert fixes.fly(5, lost=1.0, turn_deg=turn_deg) in (2, 3)
    assert fixes.watch.is_stopped


def test_a_climb_shows_it_sooner(fixes):
    fixes.fly(10, thrust=2.5)
    assert fixes.fly(5, thrust=2.5, lost=1.0) <= 2


def test_too_little_thrust_is_no_stop(fixes):
    assert fixes.fly(60, lost=0.35) is None


def test_without_throttle_nothing_is_known(fixes):
    assert fixes.fly(20, thrust=0.05, lost=1.0) is None


def test_a_single_gust_takes_more_speed_than_the_thrust_and_is_no_stop(fixes):
    fixes.gust = -1.1 + 0j
    assert fixes.fly(1) is None
    fixes.gust = 0j
    assert fixes.fly(10) is None


def test_after_gusts_a_verdict_takes_more():
    calm, rough = Fixes(), Fixes()
    assert calm.fly(80) is None
    assert rough.fly(80, gusts=(0.0, 0.4, 0.8, 1.2, 1.2, 0.8, 0.4, 0.0)) is None
    assert calm.fly(8) is rough.fly(8) is None
    assert calm.fly(10, lost=0.75) < (rough.fly(10, lost=0.75) or 99)


@pytest.mark.parametrize(("variance", "verdict"), [(9.0, False), (0.0, True)])
def test_an_unknown_wind_is_no_stop_while_the_nose_turns(variance, verdict):
    fixes = Fixes()
    fixes.gust = 3 + 0j
    fixes.wind_variance = variance
    assert (fixes.fly(60, turn_deg=12.6) is not None) is verdict


def test_a_motor_that_pulls_again_is_seen(fixes):
    fixes.fly(5, lost=1.0)
    assert fixes.fly(10, thrust=2.0, lost=1.0) is None
    assert fixes.fly(10, thrust=2.0) <= 4
    assert not fixes.watch.is_stopped


def test_a_glide_far_above_its_model_is_none(fixes):
    fixes.fly(5, lost=1.0)
    fixes.factor = 1.35
    assert fixes.fly(5, thrust=0.0) is None
    fixes.factor = 1.45
    assert fixes.fly(1, thrust=0.0) == 1


def test_what_happened_during_a_gap_is_not_judged(fixes):
    assert fixes.fly(1, lost=1.0, step_s=4.0) is None
    assert fixes.fly(10) is None


def test_an_attitude_that_was_found_anew_is_not_judged_for_ten_seconds(fixes):
    fixes.unseen_s = 3.0
    assert fixes.fly(9, lost=1.0) is None
    assert fixes.fly(6, lost=1.0) in (4, 5)
