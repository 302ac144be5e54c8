import math

import pytest

from tests.simulator.pi import GAINS, pulses_for
from up_simulator.airframe import AIRFRAMES
from up_simulator.flight import NEUTRAL
from up_simulator.flight_model import STEP_S, FlightModel
from up_simulator.servo import ServoRack

NAMES = sorted(AIRFRAMES)


def calm(name="minisgs"):
    return FlightModel(AIRFRAMES[name], wind_m_s=0.0, turbulence=0)


def attitude(state):
    rates = (state.roll_rate_deg_s, state.pitch_rate_deg_s, state.yaw_rate_deg_s)
    return state.roll_deg, state.pitch_deg, rates


def fly(model, duration_s, pilot):
    """Fly with a pilot who looks at 50 Hz and return the worst roll and pitch after 5 s."""
    worst_roll_deg = worst_pitch_deg = 0.0
    for tick in range(int(duration_s * 50)):
        state = model.state
        model.set_servos(pilot(state))
        model.advance(0.02)
        if tick >= 250:
            worst_roll_deg = max(worst_roll_deg, abs(state.roll_deg))
            worst_pitch_deg = max(worst_pitch_deg, abs(state.pitch_deg))
    return worst_roll_deg, worst_pitch_deg


def closed_loop(state):
    ailerons, elevator, rudder = pulses_for(attitude(state), GAINS)
    return ailerons, elevator, 1000, rudder


def hands_off(_state):
    return NEUTRAL


@pytest.mark.parametrize("name", NAMES)
def test_it_starts_level_in_the_air_where_it_should(name):
    state = calm(name).state
    assert state.height_m == pytest.approx(400.0, abs=1.0)
    assert state.altitude_m == pytest.approx(650.0, abs=1.0)
    assert (state.latitude_deg, state.longitude_deg) == pytest.approx((50.0, 14.5), abs=1e-3)
    assert state.roll_deg == pytest.approx(0.0, abs=0.1)
    assert state.airspeed_m_s == pytest.approx(AIRFRAMES[name].airspeed_m_s, rel=0.08)


@pytest.mark.parametrize("wind_m_s", [0.0, 5.0, 10.0])
def test_wind_carries_over_the_ground_and_leaves_the_airspeed(wind_m_s):
    state = FlightModel(AIRFRAMES["minisgs"], wind_m_s=wind_m_s, turbulence=0).state
    assert state.airspeed_m_s == pytest.approx(8.3, rel=0.08)
    assert state.speed_m_s == pytest.approx(8.3 + wind_m_s, rel=0.08)


SURFACES = [(0, "roll_deg", "roll_rate_deg_s"), (1, "pitch_deg", "pitch_rate_deg_s")]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("pulse_us", [1600, 1400])
@pytest.mark.parametrize(("channel", "angle", "rate"), SURFACES)
def test_a_pulse_above_1500_rolls_right_and_pitches_up(name, channel, angle, rate, pulse_us):
    model, neutral = calm(name), calm(name)
    pulses = list(NEUTRAL)
    pulses[channel] = pulse_us
    model.set_servos(tuple(pulses))
    neutral.set_servos(NEUTRAL)
    for each in (model, neutral):
        each.advance(0.5)
    sign = math.copysign(1.0, pulse_us - 1500)
    assert sign * (getattr(model.state, angle) - getattr(neutral.state, angle)) > 0.5
    assert sign * (getattr(model.state, rate) - getattr(neutral.state, rate)) > 1.0


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("pulse_us", [1700, 1300])
def test_rudder_above_1500_swings_the_nose_right(name, pulse_us):
    model, neutral = calm(name), calm(name)
    model.set_servos((1500, 1500, 1000, pulse_us))
    for each in (model, neutral):
        each.advance(0.3)
    swing = model.state.yaw_rate_deg_s - neutral.state.yaw_rate_deg_s
    assert math.copysign(1.0, pulse_us - 1500) * swing > 1.0


def test_throttle_drives_the_motor_of_an_aircraft_that_has_one():
    idle, full = calm("c172x"), calm("c172x")
    idle.set_servos((1500, 1500, 1000, 1500))
    full.set_servos((1500, 1500, 2000, 1500))
    for each in (idle, full):
        each.advance(5.0)
    energy = [each.state.airspeed_m_s**2 / 2 + 9.81 * each.state.height_m for each in (idle, full)]
    assert energy[1] > energy[0] + 50


def test_rates_are_the_change_of_the_angles():
    model = calm()
    model.set_servos((1550, 1500, 1000, 1500))
    model.advance(0.2)
    before = model.state
    model.advance(0.02)
    after = model.state
    seen = (after.roll_deg - before.roll_deg) / 0.02
    assert seen == pytest.approx((before.roll_rate_deg_s + after.roll_rate_deg_s) / 2, rel=0.15)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_proportional_cascade_holds_it_level_in_wind_and_turbulence(seed):
    model = FlightModel(AIRFRAMES["minisgs"], wind_m_s=5.0, turbulence=3, seed=seed)
    roll_deg, pitch_deg = fly(model, 60.0, closed_loop)
    assert roll_deg < 10.0
    assert pitch_deg < 10.0
    assert model.launches == 1


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_without_control_it_does_not_stay_level(seed):
    model = FlightModel(AIRFRAMES["minisgs"], wind_m_s=5.0, turbulence=3, seed=seed)
    roll_deg, pitch_deg = fly(model, 60.0, hands_off)
    assert roll_deg > 25.0
    assert pitch_deg > 12.0


def test_a_held_bank_is_flown_round():
    model = calm()
    for _ in range(1000):
        ailerons, elevator, rudder = pulses_for(attitude(model.state), GAINS, (20.0, -4.0))
        model.set_servos((ailerons, elevator, 1000, rudder))
        model.advance(0.02)
    assert model.state.roll_deg == pytest.approx(20.0, abs=3.0)
    assert model.state.yaw_rate_deg_s > 5.0


def test_a_glider_flown_level_soars_for_long():
    model = FlightModel(AIRFRAMES["minisgs"], wind_m_s=3.0, turbulence=3)
    fly(model, 900.0, closed_loop)
    assert model.launches == 1
    assert 250.0 < model.state.height_m < 550.0


def flown(seed):
    model = FlightModel(AIRFRAMES["minisgs"], seed=seed)
    fly(model, 10.0, closed_loop)
    return model.state


def test_the_same_seed_flies_the_same_flight_and_another_another():
    assert flown(7) == flown(7)
    assert flown(7).roll_deg != flown(8).roll_deg


def test_how_the_time_is_cut_does_not_matter():
    whole, cut = calm(), calm()
    whole.advance(1.0)
    for _ in range(1000):
        cut.advance(0.001)
    assert whole.state == cut.state
    assert whole.state.time_s == pytest.approx(1.0)


def test_a_crash_is_said_and_launches_again():
    said = []
    model = FlightModel(AIRFRAMES["minisgs"], turbulence=0, say=said.append)
    model.set_servos((2000, 1000, 1000, 1500))
    for _ in range(4000):
        model.advance(0.02)
        if said:
            break
    assert "crashed" in said[0]
    assert model.launches == 2
    assert model.state.height_m > 390.0
    time_s = model.state.time_s
    model.advance(0.1)
    assert model.state.time_s > time_s


def test_a_state_that_is_no_number_launches_again():
    said = []
    model = FlightModel(AIRFRAMES["minisgs"], say=said.append)
    model._fdm["fcs/elevator-pos-rad"] = math.nan
    model._fdm["atmosphere/wind-north-fps"] = math.nan
    model.advance(1.0)
    assert len(said) == 1
    assert math.isfinite(model.state.roll_deg)


def test_servos_take_their_time():
    rack = ServoRack(slew_us_per_s=5000.0)
    rack.set((2000, 1500, 1000, 1490))
    rack.step(STEP_S)
    assert rack.rounded_us == (1525, 1500, 1000, 1490)
    for _ in range(19):
        rack.step(STEP_S)
    assert rack.rounded_us == (2000, 1500, 1000, 1490)
