"""Each rule of the motor watch, on accelerations of an aircraft that is known exactly."""

import math

import pytest

from raspilot.navigation.air_path import AirPoint
from raspilot.navigation.motor_watch import MotorWatch

LEVEL_M_S2 = 0.9
PERIOD_S = 0.2


class Accelerations:
    """One each 0.2 s; ``lost`` is the share of the thrust that the motor does not give."""

    def __init__(self):
        self.watch = MotorWatch()
        self.point = AirPoint(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 11.0, 0.0, 0.0)

    def fly(
        self,
        seconds,
        *,
        thrust=LEVEL_M_S2,
        lost=0.0,
        error_m_s2=0.0,
        coast=-LEVEL_M_S2,
        period_s=PERIOD_S,
    ):
        """Return when the verdict changed, s, and the airspeed that it gave; None: it did not."""
        for count in range(1, round(seconds / period_s) + 1):
            begin = self.point
            self.point = begin._replace(
                time_s=begin.time_s + period_s,
                thrust_m_s=begin.thrust_m_s + period_s * thrust,
                coast_m_s=begin.coast_m_s + period_s * coast,
            )
            felt_m_s2 = (1.0 - lost) * thrust + coast + error_m_s2
            gained_m_s = self.watch.acceleration(felt_m_s2, begin, self.point)
            if gained_m_s is not None:
                return count * period_s, gained_m_s
        return None


@pytest.fixture
def flight():
    flight = Accelerations()
    assert flight.fly(12) is None
    return flight


@pytest.mark.parametrize(("thrust", "allowed_s"), [(0.6, 2.5), (LEVEL_M_S2, 1.2), (2.5, 0.7)])
def test_a_stop_is_seen_the_sooner_the_more_thrust_is_missing(flight, thrust, allowed_s):
    flight.fly(10, thrust=thrust)
    seen_s, gained_m_s = flight.fly(5, thrust=thrust, lost=1.0)
    assert flight.watch.is_stopped
    assert seen_s <= allowed_s
    assert gained_m_s == pytest.approx(-thrust * seen_s), "what the motor has not given"


def test_the_first_ten_seconds_of_a_flight_are_not_judged():
    flight = Accelerations()
    assert flight.fly(9.8, error_m_s2=-2.4) is None
    assert flight.fly(5) is None
    assert flight.fly(2, lost=1.0), "then it is seen, without any turn"


def test_the_tilt_of_the_take_off_is_no_stop():
    flight = Accelerations()
    for second in range(40):
        tilt_m_s2 = -0.7 * math.exp(-max(0.0, second - 18.0) / 5.0)
        assert flight.fly(1, thrust=1.3 if second < 12 else 0.8, error_m_s2=tilt_m_s2) is None


def test_an_error_larger_than_the_thrust_is_no_stop(flight):
    for second in range(30):
        drift_m_s2 = -0.5 * math.sin(second / 10.0)
        assert flight.fly(1, thrust=0.15, error_m_s2=drift_m_s2) is None
    assert flight.fly(2, thrust=2.5, lost=1.0), "seen when the throttle opens"


@pytest.mark.parametrize("thrust", [LEVEL_M_S2, 2.5])
def test_too_little_thrust_is_no_stop(flight, thrust):
    assert flight.fly(60, thrust=thrust, lost=0.4) is None


def test_a_weak_motor_is_no_stop_when_the_throttle_moves(flight):
    for second in range(30):
        assert flight.fly(1, thrust=1.5 + math.sin(second), lost=0.4) is None


def test_without_throttle_nothing_is_known(flight):
    assert flight.fly(20, thrust=0.0, lost=1.0, error_m_s2=-0.8) is None


def test_one_senseless_acceleration_is_no_stop(flight):
    assert flight.fly(PERIOD_S, error_m_s2=-40.0) is None
    assert flight.fly(10) is None


def test_a_constant_error_of_the_attitude_is_learned(flight):
    assert flight.fly(60, error_m_s2=-0.4) is None
    assert flight.fly(10, error_m_s2=-0.75) is None
    assert flight.fly(2, error_m_s2=-0.4, lost=1.0)


def test_a_motor_that_pulls_again_is_seen(flight):
    flight.fly(5, lost=1.0)
    assert flight.fly(10, thrust=1.5, lost=1.0) is None
    seen_s, gained_m_s = flight.fly(10, thrust=1.5)
    assert not flight.watch.is_stopped
    assert seen_s <= 1.0
    assert gained_m_s == pytest.approx(1.5 * seen_s)


def test_an_attitude_that_was_found_anew_is_not_judged_for_ten_seconds(flight):
    flight.point = flight.point._replace(unseen_s=3.0)
    assert flight.fly(9.8, error_m_s2=-2.4) is None
    assert flight.fly(9.8) is None
    assert flight.fly(2, lost=1.0)


def test_after_a_dive_nothing_is_judged_for_ten_seconds(flight):
    assert flight.fly(1.2, thrust=0.0, coast=1.8) is None
    assert flight.fly(9.8, error_m_s2=-2.4) is None
    assert flight.fly(9.8) is None
    assert flight.fly(2, lost=1.0)


def test_a_push_at_idle_is_no_dive(flight):
    """Such a push came half a second after a stop, and the airspeed fell to 1.11 times stall."""
    assert flight.fly(3 * PERIOD_S, thrust=0.0, lost=1.0, coast=1.6) is None
    assert flight.fly(2, lost=1.0)
