"""A throw from the hand and a landing: what the board's IMU and the phone see of them."""

import math

import pytest

from tests.simulator.aircraft.pilot import hold_pitch, move, wings_level
from up_simulator.aircraft import FlightDynamics, Start, Weather, load_airframe


def made(start, *, may_land=True, **weather):
    return FlightDynamics(load_airframe("glider"), start, Weather(**weather), may_land=may_land)


def held(**weather):
    return made(Start(height_m=1.8, heading_deg=90.0, pitch_deg=5.0, throw_m_s=9.0), **weather)


def test_a_hand_holds_it_still_and_a_throw_accelerates_it_along_its_way():
    flight = held()
    flight.advance(3.0)
    state, motion = flight.state, flight.motion
    assert (state.speed_m_s, state.climb_m_s, state.height_m) == pytest.approx(
        (0, 0, 1.8), abs=0.01
    )
    assert state.east_m == pytest.approx(-1.5, abs=0.01)
    assert state.time_s == pytest.approx(3.0)
    assert math.hypot(motion.force_x_m_s2, motion.force_z_m_s2) == pytest.approx(9.81, abs=0.01)
    still_m_s2 = motion.force_x_m_s2
    flight.is_thrown = True
    flight.advance(0.1)
    assert flight.motion.force_x_m_s2 - still_m_s2 == pytest.approx(9.0**2 / 3.0, abs=0.01)
    assert flight.state.speed_m_s == pytest.approx(2.7, abs=0.1)
    flight.advance(0.26)
    assert flight.state.speed_m_s == pytest.approx(9.0, abs=0.2)
    assert flight.state.east_m == pytest.approx(0.2, abs=0.2)


def test_it_is_thrown_against_the_wind_at_an_airspeed_that_has_the_wind_in_it():
    flight = held(wind_m_s=4.0, wind_from_deg=90.0)
    flight.advance(0.1)
    assert flight.state.airspeed_m_s == pytest.approx(4.0, abs=0.1)
    flight.is_thrown = True
    flight.advance(0.36)
    assert flight.state.speed_m_s == pytest.approx(9.0, abs=0.3)
    assert flight.state.airspeed_m_s == pytest.approx(13.0, abs=0.3)


def descend(flight, pitch_deg):
    """Glide to the ground and return the last state before it and the first after."""
    before = flight.state
    for _ in range(1500):
        state = flight.state
        if state.speed_m_s == 0.0 or flight.crash or state.height_m <= 0.1:
            return before, state
        before = state
        move(flight, wings_level(state), hold_pitch(state, pitch_deg))
        flight.advance(0.02)
    raise AssertionError("it does not come down")


def test_a_soft_contact_is_a_landing_after_which_it_slides_and_stands():
    flight = made(Start(height_m=3.0))
    before, touched = descend(flight, -2.0)
    assert flight.crash is None and before.climb_m_s > -2.0
    flight.advance(0.5)
    assert flight.motion.force_x_m_s2 < -3.0
    flight.advance(5.0)
    stands = flight.state
    way_m = math.hypot(stands.north_m - touched.north_m, stands.east_m - touched.east_m)
    assert (stands.speed_m_s, stands.climb_m_s) == (0.0, 0.0)
    assert way_m == pytest.approx(touched.speed_m_s**2 / 8.0, rel=0.1)
    assert stands.time_s == pytest.approx(flight.time_s)
    assert stands.airspeed_m_s == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize(
    ("may_land", "pitch_deg", "height_m"), [(True, -40.0, 15.0), (False, -2.0, 3.0)]
)
def test_a_hard_contact_is_a_crash_and_so_is_any_without_permission(may_land, pitch_deg, height_m):
    flight = made(Start(height_m=height_m), may_land=may_land)
    descend(flight, pitch_deg)
    assert "hit the ground" in flight.crash
