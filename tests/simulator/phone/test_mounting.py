"""A phone's raw sensors are those of the truth, however it lies: worked out a second way."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.simulator.bench import StillFlight
from up_simulator.phone.sensors import MOUNTING, SWAP, PhoneSensors, body_to_world

ANGLES = st.tuples(st.floats(-179, 179), st.floats(-89, 89), st.floats(0, 359.9))
NOSE, RIGHT, DOWN = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def near(vector):
    return pytest.approx(vector, abs=1e-9)


def test_the_axes_of_a_flat_phone_are_those_of_an_android():
    assert SWAP.turn(*NOSE) == near((0, 1, 0)), "the nose is the top edge"
    assert SWAP.turn(*RIGHT) == near((1, 0, 0)), "the right wing is the right edge"
    assert SWAP.turn(*DOWN) == near((0, 0, -1)), "down is behind the screen"


@given(ANGLES)
def test_the_aircraft_lies_in_the_world_as_its_angles_say(angles):
    """By the textbook's matrix (north, east, down), not by quaternions."""
    roll, pitch, yaw = map(math.radians, angles)
    world = body_to_world(*angles)
    east, north, up = world.turn(*NOSE)
    assert (north, east, -up) == near(
        (math.cos(pitch) * math.cos(yaw), math.cos(pitch) * math.sin(yaw), -math.sin(pitch))
    )
    east, north, up = world.turn(*RIGHT)
    assert -up == near(math.cos(pitch) * math.sin(roll))
    assert north == near(
        math.sin(roll) * math.sin(pitch) * math.cos(yaw) - math.cos(roll) * math.sin(yaw)
    )


def test_the_mounting_is_not_trivial():
    """A phone that is taken to lie flat must be found out by every axis."""
    away = MOUNTING.times(SWAP.conjugate())
    assert math.degrees(2 * math.acos(abs(away.w))) > 60
    assert all(abs(part) > 0.02 for part in away)
    assert math.hypot(*MOUNTING) == pytest.approx(1.0)


def state_of(**changes):
    return replace(StillFlight().state, **changes)


@given(ANGLES)
def test_the_rotation_turned_back_by_the_mounting_is_the_attitude(angles):
    roll_deg, pitch_deg, yaw_deg = angles
    sensors = PhoneSensors(3)
    state = state_of(roll_deg=roll_deg, pitch_deg=pitch_deg, yaw_deg=yaw_deg)
    found = type(MOUNTING)(*sensors.rotation(state)).times(MOUNTING)
    # Roll and pitch have no error; north has the compass's.
    *_, up = found.turn(*NOSE)
    assert math.degrees(math.asin(max(-1, min(1, up)))) == pytest.approx(pitch_deg, abs=1e-3)
    exact = body_to_world(roll_deg, pitch_deg, yaw_deg)
    turned = found.times(exact.conjugate())
    assert (turned.x, turned.y) == pytest.approx((0, 0), abs=1e-8)
    assert abs(math.degrees(2 * math.asin(turned.z))) < 10


def test_the_rates_are_about_the_phones_axes():
    state = state_of(roll_rate_deg_s=30.0, pitch_rate_deg_s=-20.0, yaw_rate_deg_s=10.0)
    rates = PhoneSensors(1).rate_rad_s(state)
    back = MOUNTING.conjugate().turn(*rates)
    assert [math.degrees(each) for each in back] == pytest.approx([30.0, -20.0, 10.0], abs=1e-5)
    assert math.degrees(rates[0]) != pytest.approx(30.0, abs=1)


@pytest.mark.parametrize(("altitude_m", "hpa"), [(0, 1013.25), (1000, 898.74), (3000, 701.08)])
def test_the_pressure_is_that_of_the_standard_atmosphere(altitude_m, hpa):
    """By the table of ISO 2533; the noise is that of the barometer, 0.3 m."""
    found = [PhoneSensors(seed).pressure_hpa(state_of(altitude_m=altitude_m)) for seed in range(99)]
    assert sum(found) / len(found) == pytest.approx(hpa, abs=0.03)
    assert 0.01 < max(found) - min(found) < 0.4


def test_the_same_seed_measures_the_same():
    def measured(seed):
        sensors, state = PhoneSensors(seed), StillFlight().state
        return [sensors.pressure_hpa(state), sensors.rotation(state), sensors.location(state)]

    assert measured(5) == measured(5) != measured(6)
