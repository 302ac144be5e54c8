"""A model of this class in the air, with the figures of docs/simulator-airframe.md."""

import math

import pytest

from tests.simulator.aircraft.pilot import (
    TICK_S,
    fly,
    glide,
    hold_pitch,
    launched,
    move,
    peaks,
    stall,
    wings_level,
)
from up_simulator.aircraft import airframe_names
from up_simulator.aircraft.airframe import SHIPPED
from up_simulator.aircraft.derivation import Derivation
from up_simulator.aircraft.geometry import GEOMETRY

NAMES = airframe_names()
GRAVITY = 9.81
AIR_KG_M3 = 1.14
"""At 850 m above the sea."""


@pytest.mark.parametrize(("name", "cruise_m_s"), [("glider", 11.3), ("wing", 13.2)])
def test_let_go_with_the_motor_off_it_glides_straight_near_its_cruise(name, cruise_m_s):
    flight = launched(name)
    flight.advance(40.0)
    state = flight.state
    assert state.airspeed_m_s == pytest.approx(cruise_m_s, abs=0.3)
    assert state.airspeed_m_s == pytest.approx(flight.airframe.launch.airspeed_m_s, abs=0.5)
    assert abs(state.roll_deg) < 1.0
    assert state.pitch_deg == pytest.approx(flight.airframe.launch.pitch_deg, abs=0.8)


@pytest.mark.parametrize(("name", "stall_m_s"), [("glider", 6.5), ("wing", 8.1)])
def test_it_stalls_where_its_wing_loading_says(name, stall_m_s):
    """EasyGlider class 6 to 7 m/s; a wing of 24 N/m2 without flaps 7.5 to 9."""
    assert stall(name) == pytest.approx(stall_m_s, abs=0.4)


@pytest.mark.parametrize(
    ("name", "elevator_us", "ratio", "airspeed_m_s", "sink_m_s"),
    [("glider", 140, 13.5, 8.0, 0.59), ("wing", 75, 9.5, 9.9, 1.04)],
)
def test_its_best_glide(name, elevator_us, ratio, airspeed_m_s, sink_m_s):
    """Foam motor gliders reach 11 to 14 at 8 to 9 m/s, flying wings of foam 7 to 10."""
    best = glide(name, elevator_us)
    assert best.ratio == pytest.approx(ratio, abs=0.3)
    assert best.airspeed_m_s == pytest.approx(airspeed_m_s, abs=0.3)
    assert best.sink_m_s == pytest.approx(sink_m_s, abs=0.06)
    for other in (elevator_us - 60, elevator_us + 60):
        assert glide(name, other).ratio < best.ratio + 0.1


@pytest.mark.parametrize(("name", "rate_deg_s"), [("glider", 99.0), ("wing", 211.0)])
@pytest.mark.parametrize("side", [1, -1])
def test_full_ailerons_roll_it(name, rate_deg_s, side):
    """90 to 150 deg/s in the class of the EasyGlider, 150 to 300 for a wing of 1.2 m."""
    flight = launched(name)
    move(flight, ailerons=500.0 * side)
    greatest = 0.0
    for _ in range(40):
        flight.advance(TICK_S)
        greatest = max(greatest, side * flight.state.roll_rate_deg_s)
    assert greatest == pytest.approx(rate_deg_s, rel=0.05)


def swung(name):
    """Let it swing from 1.5 m/s too fast; the period and the share that is left after one."""
    flight = launched(name, airspeed_m_s=launched(name).airframe.launch.airspeed_m_s + 1.5)
    speeds = [each.airspeed_m_s for each in fly(flight, 40.0)]
    (first, high), (second, lower) = peaks(speeds[100:])[:2]
    steady = speeds[-1]
    return (second - first) * TICK_S, (lower - steady) / (high - steady), steady


@pytest.mark.parametrize(("name", "period_s"), [("glider", 8.1), ("wing", 6.25)])
def test_the_phugoid_is_lanchesters_longer_by_what_a_light_aircraft_adds(name, period_s):
    """T = pi sqrt(2) V / g times sqrt(manoeuvre margin / static margin).

    Lanchester's own (5.1 and 6.0 s) leaves out that pitch damping keeps a light aircraft from
    turning its nose along: manoeuvre margin = static margin - Cm_q / (2 mu), mu = 2 m / (rho S c).
    """
    found = Derivation(GEOMETRY.load(SHIPPED / name))
    seen_s, left, steady_m_s = swung(name)
    at = 0.4 if name == "glider" else 3.8
    static = -(found.pitch(at + 1) - found.pitch(at - 1)) / (
        found.lift(at + 1) - found.lift(at - 1)
    )
    relative = 2 * found.geometry.masses.mass_kg / (AIR_KG_M3 * found.area_m2 * found.chord_m)
    manoeuvre = static - found.by("pitch").pitch / (2 * relative)
    lanchester_s = math.pi * math.sqrt(2) * steady_m_s / GRAVITY
    assert seen_s == pytest.approx(period_s, rel=0.05)
    assert seen_s == pytest.approx(lanchester_s * math.sqrt(manoeuvre / static), rel=0.07)
    assert 0.2 < left < 0.8


@pytest.mark.parametrize("name", NAMES)
def test_the_short_period_is_well_damped(name):
    flight = launched(name, pitch_rate_deg_s=40.0)
    steady = flight.state.alpha_deg
    off = []
    for _ in range(100):
        flight.advance(0.01)
        off.append(flight.state.alpha_deg - steady)
    greatest = max(off)
    assert greatest > 0.5
    assert min(off) > -0.25 * greatest
    assert max(map(abs, off[60:])) < 0.35 * greatest


@pytest.mark.parametrize("name", NAMES)
def test_a_sideslip_swings_out(name):
    """Dutch roll: period 0.7 to 1.6 s, less than half left after each."""
    flight = launched(name, yaw_rate_deg_s=30.0)
    slips = []
    for _ in range(300):
        flight.advance(TICK_S)
        slips.append(-flight.state.sideslip_deg)
    tops = peaks(slips)
    assert 0.7 < (tops[1][0] - tops[0][0]) * TICK_S < 1.7
    assert tops[1][1] < 0.65 * tops[0][1]
    assert tops[2][1] < 0.65 * tops[1][1]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("bank_deg", [10.0, -10.0])
def test_the_spiral_mode_is_mild(name, bank_deg):
    """Let go in a bank of 10 degrees it is neither level after 10 s nor steeper after 30."""
    flight = launched(name, roll_deg=bank_deg)
    flight.advance(10.0)
    assert 2.0 < flight.state.roll_deg * math.copysign(1, bank_deg) < 10.0
    flight.advance(20.0)
    assert 0.0 < flight.state.roll_deg * math.copysign(1, bank_deg) < 10.0


@pytest.mark.parametrize(("name", "climb_m_s"), [("glider", 6.8), ("wing", 8.8)])
def test_it_climbs_with_full_power(name, climb_m_s):
    """At 30 degrees; 150 to 200 W of electricity for each."""
    flight = launched(name)
    heights = []
    for _ in range(700):
        move(flight, wings_level(flight.state), hold_pitch(flight.state, 30.0), 2000.0)
        flight.advance(TICK_S)
        heights.append(flight.state.height_m)
    assert (heights[-1] - heights[349]) / 7.0 == pytest.approx(climb_m_s, rel=0.07)
    assert 150 < flight.state.motor_w < 200


@pytest.mark.parametrize("name", NAMES)
def test_its_throttle_for_level_flight_holds_the_height(name):
    flight = launched(name)
    states = fly(flight, 30.0, throttle_us=1000 + 1000 * flight.airframe.launch.level_throttle)
    assert abs(states[-1].height_m - states[-1000].height_m) / 20.0 < 0.15
    assert 15 < states[-1].motor_w < 40


@pytest.mark.parametrize("name", NAMES)
def test_rudder_or_not_a_right_turn_is_flown_round(name):
    """At 30 degrees of bank the heading changes by g tan(phi) / V."""
    flight = launched(name)
    rates = []
    for tick in range(600):
        state = flight.state
        bank = max(-400.0, min(400.0, 8 * (30 - state.roll_deg) - 2 * state.roll_rate_deg_s))
        move(flight, bank, hold_pitch(state, -5.0), 1450)
        flight.advance(TICK_S)
        if tick >= 400:
            rates.append((flight.state.yaw_deg - state.yaw_deg + 180) % 360 - 180)
    seen_deg_s = sum(rates) / len(rates) / TICK_S
    expected = GRAVITY * math.tan(math.radians(flight.state.roll_deg)) / flight.state.airspeed_m_s
    assert flight.state.roll_deg > 25.0
    assert seen_deg_s == pytest.approx(math.degrees(expected), rel=0.12)


@pytest.mark.parametrize("name", NAMES)
def test_held_in_a_steep_bank_it_spirals_down_faster_and_faster_within_bounds(name):
    """The start of the save: 60 degrees of bank held by the ailerons, nothing pulled."""
    flight = launched(name, roll_deg=60.0)
    for _ in range(400):
        state = flight.state
        move(flight, max(-300.0, min(300.0, 8 * (60 - state.roll_deg) - state.roll_rate_deg_s)))
        flight.advance(TICK_S)
    assert flight.crash is None
    state = flight.state
    assert state.climb_m_s < -4.0
    assert flight.airframe.launch.airspeed_m_s + 2 < state.airspeed_m_s < 45.0
    assert state.load_factor_g < flight.airframe.limits.load_g


@pytest.mark.parametrize("name", NAMES)
def test_pulled_into_the_stall_it_drops_its_nose_and_flies_again(name):
    flight = launched(name)
    for tick in range(500):
        move(flight, wings_level(flight.state), min(450.0, tick * 1.0))
        flight.advance(TICK_S)
    assert flight.crash is None
    fly(flight, 12.0)
    state = flight.state
    assert abs(state.roll_deg) < 10.0
    assert state.alpha_deg < 8.0
    assert state.airspeed_m_s == pytest.approx(flight.airframe.launch.airspeed_m_s, abs=4.0)
