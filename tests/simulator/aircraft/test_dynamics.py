"""The flight dynamics: conventions, determinism, weather, crashes; JSBSim itself flies."""

import math
import shutil

import pytest

from up_simulator.aircraft import (
    FlightDynamics,
    Gust,
    Start,
    Weather,
    airframe_names,
    load_airframe,
)
from up_simulator.aircraft.airframe import SHIPPED
from up_simulator.aircraft.flight import NEUTRAL
from up_simulator.aircraft.servos import ServoRack

NAMES = airframe_names()
HANDS_OFF = tuple(float(each) for each in NEUTRAL)


def flying(name="glider", start=None, **weather):
    return FlightDynamics(load_airframe(name), start, Weather(**weather))


def pushed(name, channel, pulse_us):
    """Demand by the sticks: the firmware of an aircraft with elevons mixes."""
    sticks = list(NEUTRAL)
    sticks[channel] = pulse_us
    if load_airframe(name).profile.get("mix") == "elevon":
        ailerons, elevator = sticks[0] - 1500, sticks[1] - 1500
        sticks[:2] = 1500 + elevator - ailerons, 1500 + elevator + ailerons
    return tuple(sticks)


@pytest.mark.parametrize("name", NAMES)
def test_a_flight_starts_at_cruise_and_at_its_position(name):
    flight = flying(name)
    state, launch = flight.state, flight.airframe.launch
    assert state.height_m == pytest.approx(120.0, abs=0.1)
    assert state.altitude_m == pytest.approx(370.0, abs=0.1)
    assert (state.latitude_deg, state.longitude_deg) == pytest.approx((50.0, 14.5), abs=1e-6)
    assert (state.north_m, state.east_m) == pytest.approx((0.0, 0.0), abs=0.01)
    assert state.airspeed_m_s == pytest.approx(launch.airspeed_m_s)
    assert state.roll_deg == pytest.approx(0.0, abs=1e-6)
    assert state.battery_percent == 100.0


@pytest.mark.parametrize("from_deg", [0.0, 90.0, 200.0, 315.0])
@pytest.mark.parametrize(("heading_deg", "roll_deg"), [(0.0, 0.0), (130.0, 40.0)])
def test_wind_changes_the_ground_speed_only(from_deg, heading_deg, roll_deg):
    start = Start(heading_deg=heading_deg, roll_deg=roll_deg)
    state = flying(start=start, wind_m_s=6.0, wind_from_deg=from_deg).state
    assert state.airspeed_m_s == pytest.approx(11.0, abs=0.01)
    assert state.sideslip_deg == pytest.approx(0.0, abs=0.01)
    along, to = math.radians(heading_deg), math.radians(from_deg + 180)
    through = 11.0 * math.cos(math.radians(5.6))
    north = through * math.cos(along) + 6.0 * math.cos(to)
    east = through * math.sin(along) + 6.0 * math.sin(to)
    assert state.speed_m_s == pytest.approx(math.hypot(north, east), abs=0.2)
    wind = state.wind_north_m_s, state.wind_east_m_s, state.wind_down_m_s
    assert wind == pytest.approx((6.0 * math.cos(to), 6.0 * math.sin(to), 0.0), abs=1e-6)
    off_deg = (state.track_deg - math.degrees(math.atan2(east, north)) + 180) % 360 - 180
    assert abs(off_deg) < 1.5


# The wing has no rudder.
SURFACES = [(name, *each) for name in NAMES for each in ((0, "roll"), (1, "pitch"))]
SURFACES.append(("glider", 3, "yaw"))


@pytest.mark.parametrize("pulse_us", [1600, 1400])
@pytest.mark.parametrize(("name", "channel", "axis"), SURFACES)
def test_a_stick_above_1500_rolls_right_pitches_up_and_yaws_right(name, channel, axis, pulse_us):
    model, neutral = flying(name), flying(name)
    model.set_servos(pushed(name, channel, pulse_us))
    for each in (model, neutral):
        each.advance(0.3)
    turned = getattr(model.state, f"{axis}_rate_deg_s") - getattr(
        neutral.state, f"{axis}_rate_deg_s"
    )
    assert math.copysign(1.0, pulse_us - 1500) * turned > 5.0


@pytest.mark.parametrize("name", NAMES)
def test_throttle_makes_thrust_and_empties_the_battery(name):
    idle, full = flying(name), flying(name)
    full.set_servos((1500, 1500, 2000, 1500))
    for each in (idle, full):
        each.advance(4.0)
    energy = [each.state.airspeed_m_s**2 / 2 + 9.81 * each.state.height_m for each in (idle, full)]
    assert energy[1] > energy[0] + 100
    assert full.state.battery_percent < idle.state.battery_percent
    assert full.state.battery_v < idle.state.battery_v - 0.2
    assert full.state.motor_rpm > 5000 and full.state.motor_w > 80
    assert idle.state.motor_rpm == 0.0


def test_the_imu_measures_1_g_in_a_steady_glide():
    flight = flying()
    flight.advance(20.0)
    motion, state = flight.motion, flight.state
    assert motion.force_z_m_s2 == pytest.approx(-9.81, abs=0.15)
    assert motion.force_x_m_s2 == pytest.approx(
        9.81 * math.sin(math.radians(state.pitch_deg)), abs=0.1
    )
    assert motion.force_y_m_s2 == pytest.approx(0.0, abs=0.05)
    assert motion.pitch_rate_deg_s == state.pitch_rate_deg_s
    assert state.load_factor_g == pytest.approx(-motion.force_z_m_s2 / 9.80665, abs=0.01)


def test_an_imu_ahead_of_the_centre_measures_the_rotation(tmp_path):
    """On a long nose a pitch rate q pulls with q^2 x, and its beginning lifts."""
    text = (SHIPPED / "glider" / "airframe.yml").read_text()
    folder = tmp_path / "long"
    folder.mkdir()
    (folder / "airframe.yml").write_text(text.replace("x_m: 0.05", "x_m: 4.0"))
    shutil.copy(SHIPPED / "glider" / "geometry.yml", folder)
    ahead, near = FlightDynamics(load_airframe(folder)), flying()
    for each in (ahead, near):
        each.set_servos((1500, 1800, 1000, 1500))
        each.advance(0.25)
    q = math.radians(near.motion.pitch_rate_deg_s)
    assert q > 0.5
    before = near.motion.pitch_rate_deg_s
    near.advance(0.002)
    q_dot = math.radians(near.motion.pitch_rate_deg_s - before) / 0.002
    lifted = ahead.motion.force_z_m_s2 - near.motion.force_z_m_s2
    assert lifted == pytest.approx(-q_dot * (4.0 - 0.05), rel=0.1)
    felt = ahead.motion.force_x_m_s2 - near.motion.force_x_m_s2
    assert felt == pytest.approx(-(q**2) * (4.0 - 0.05), rel=0.05)


@pytest.mark.parametrize("heading_deg", [0.0, 90.0, 225.0])
def test_the_position_is_in_metres(heading_deg):
    flight = flying(start=Start(heading_deg=heading_deg))
    flight.advance(10.0)
    state = flight.state
    flown_m = 10 * 11.0
    along = math.radians(heading_deg)
    assert state.north_m == pytest.approx(flown_m * math.cos(along), abs=4.0)
    assert state.east_m == pytest.approx(flown_m * math.sin(along), abs=4.0)


def flown(seed, name="glider"):
    weather = Weather(wind_m_s=4.0, turbulence="moderate", gusts=(Gust(1.0, 0.5, down_m_s=3.0),))
    flight = FlightDynamics(load_airframe(name), Start(height_m=100.0), weather, seed)
    for tick in range(250):
        flight.set_servos((1500 + tick % 7, 1500 - tick % 5, 1000 + tick, 1500))
        flight.advance(0.02)
    return flight.state, flight.motion


@pytest.mark.parametrize("name", NAMES)
def test_the_same_seed_gives_the_same_flight(name):
    assert flown(7, name) == flown(7, name) != flown(8, name)


def test_the_step_size_of_the_caller_does_not_matter():
    whole, cut = flying(), flying()
    whole.advance(1.0)
    for _ in range(1000):
        cut.advance(0.001)
    assert whole.state == cut.state
    assert whole.state.time_s == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("level", "least", "most"),
    [("light", 0.2, 0.8), ("moderate", 0.5, 1.2), ("severe", 0.8, 2.0)],
)
def test_turbulence_has_the_strength_of_its_level(level, least, most):
    """Vertical gusts, rms in m/s, at the heights that a model flies at."""
    flight = flying(start=Start(height_m=300.0), turbulence=level)
    squares = []
    for _ in range(1500):
        flight.advance(0.04)
        if flight.crash:
            break
        squares.append((flight._fdm["atmosphere/total-wind-down-fps"] * 0.3048) ** 2)
    assert len(squares) > 200
    assert least < math.sqrt(sum(squares) / len(squares)) < most


def test_a_gust_has_the_shape_of_one_minus_cosine():
    flight = flying(gusts=(Gust(0.5, 1.0, north_m_s=2.0, down_m_s=-4.0),))
    seen = {}
    for step in range(1000):
        flight.step()
        seen[step + 1] = flight.state.wind_north_m_s, flight.state.wind_down_m_s
    assert seen[240] == pytest.approx((0.0, 0.0), abs=1e-9)
    assert seen[375] == pytest.approx((1.0, -2.0), abs=0.05)
    assert seen[500] == pytest.approx((2.0, -4.0), abs=0.05)
    assert seen[625] == pytest.approx((1.0, -2.0), abs=0.05)
    assert seen[760] == pytest.approx((0.0, 0.0), abs=1e-9)


def test_a_vertical_gust_loads_the_wing():
    calm, struck = flying(), flying(gusts=(Gust(0.1, 0.4, down_m_s=-5.0),))
    greatest = 0.0
    for _ in range(300):
        calm.step()
        struck.step()
        greatest = max(greatest, struck.state.load_factor_g - calm.state.load_factor_g)
    # Half the gust's angle of 24 degrees in lift would be 2 g; the wing stalls and the nose yields.
    assert 0.7 < greatest < 3.5


def test_the_ground_ends_the_flight():
    flight = flying(start=Start(height_m=20.0, pitch_deg=-70.0))
    flight.advance(5.0)
    assert flight.crash is not None
    state = flight.state
    assert state.height_m < 0.5
    flight.advance(1.0)
    after = flight.state
    assert after.time_s == pytest.approx(state.time_s + 1.0)
    assert (after.height_m, after.north_m) == (state.height_m, state.north_m)


def test_a_load_above_the_limit_breaks_the_aircraft():
    flight = flying(start=Start(height_m=300.0, airspeed_m_s=45.0, pitch_deg=-60.0))
    flight.set_servos((1500, 2000, 1000, 1500))
    flight.advance(3.0)
    assert flight.crash is not None and flight.state.height_m > 100.0


def test_a_diverged_model_is_a_crash():
    flight = flying()
    flight._fdm["fcs/elevator-pos-rad"] = math.nan
    flight._moves.clear()
    flight.advance(1.0)
    assert flight.crash is not None


def test_an_exception_of_jsbsim_in_flight_is_a_crash(monkeypatch):
    class Thrower:
        def __getattr__(self, name):
            raise RuntimeError("no answer")

    flight = flying()
    monkeypatch.setattr(flight, "_fdm", Thrower())
    flight.advance(0.01)
    assert "no answer" in flight.crash


@pytest.mark.parametrize("name", NAMES)
def test_a_flight_may_be_launched_again(name):
    flight = flying(name, Start(height_m=5.0, pitch_deg=-60.0))
    flight.advance(3.0)
    assert flight.crash
    flight.launch(Start(height_m=80.0))
    assert flight.crash is None
    assert flight.state.height_m == pytest.approx(80.0, abs=0.1)
    assert flight.state.time_s == pytest.approx(3.0)
    flight.advance(1.0)
    assert flight.state.north_m > 5.0
    assert flight.state.roll_deg == pytest.approx(0.0, abs=1.0)


def test_a_launch_under_power_has_immediate_thrust():
    gliding, driven = flying(), flying(start=Start(throttle=0.8))
    assert driven.state.motor_rpm > 5000
    assert driven.servos[2] == 1800
    driven.set_servos((1500, 1500, 1800, 1500))
    for each in (gliding, driven):
        each.advance(0.5)
    assert driven.state.airspeed_m_s > gliding.state.airspeed_m_s + 0.5


ATTITUDES = [
    (roll, pitch, alpha, airspeed)
    for roll in (0.0, 90.0, 180.0)
    for pitch in (-89.0, 45.0, 89.0)
    for alpha in (0.0, 30.0)
    for airspeed in (0.5, 30.0)
]


@pytest.mark.parametrize("name", NAMES)
def test_from_any_attitude_the_state_stays_finite_and_the_nose_comes_down(name):
    """Spins, tail slides, inverted flight: nothing diverges, and the drag bounds the speed."""
    for roll, pitch, alpha, airspeed in ATTITUDES:
        climb = airspeed * math.sin(math.radians(pitch - alpha))
        start = Start(
            height_m=400.0, roll_deg=roll, pitch_deg=pitch, airspeed_m_s=airspeed, climb_m_s=climb
        )
        flight = flying(name, start)
        flight.set_servos((1700, 1900, 1000, 1900))
        flight.advance(4.0)
        state = flight.state
        assert all(math.isfinite(getattr(state, each)) for each in state.__slots__)
        assert flight.crash is None or flight.crash.startswith("broke")
        assert state.airspeed_m_s < 55.0


@pytest.mark.parametrize("pulses_us", [(1500, 1500, 1000, 1500)])
def test_servos_are_limited_by_their_slew_rate(pulses_us):
    servos = ServoRack(6000.0, 0.015, 0.002)
    servos.set((2000, 1500, 1000, 1490))
    servos.step()
    assert servos.rounded_us == (1512, 1500, 1000, 1499)
    for _ in range(100):
        servos.step()
    assert servos.rounded_us == (2000, 1500, 1000, 1490)
    servos.set(pulses_us)
    for _ in range(250):
        servos.step()
    assert servos.rounded_us == pulses_us


def test_a_servo_has_a_dead_band_and_play():
    def settled(pulse_us):
        servos.set((pulse_us, 1500, 1500, 1500))
        for _ in range(250):
            servos.step()
        return servos.positions_us[0]

    servos = ServoRack(6000.0, 0.015, 0.002, dead_band_us=3.0, play_us=8.0)
    assert settled(1502.9) == 1500.0
    # Short of its pulse by the dead band, and the surface by half of the play.
    assert settled(1600) == pytest.approx(1600 - 3 - 4, abs=0.5)
    assert settled(1592) == pytest.approx(1593, abs=0.5)
    assert settled(1500) == pytest.approx(1500 + 3 + 4, abs=0.5)
    assert servos.positions_us[2] == 1500.0
