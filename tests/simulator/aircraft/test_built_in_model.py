"""The built-in flight model against JSBSim, in the terms of docs/simulator-airframe.md."""

import math
import sys

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
from up_simulator.aircraft import FlightDynamics, Start, Weather, airframe_names, load_airframe
from up_simulator.aircraft.built_in_model import BuiltInModel
from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.aircraft.model import FOOT_M, chosen_model, load_model
from up_simulator.aircraft.turbulence import DrydenTurbulence

NAMES = airframe_names()
BEST_GLIDE_US = {"glider": 140, "wing": 75}
# Quality: greatest difference, absolute or a share of JSBSim's figure.
LIMITS = {
    "trim_m_s": (0.05, 0.0),
    "trim_pitch_deg": (0.1, 0.0),
    "level_throttle": (0.005, 0.0),
    "glide_ratio": (0.0, 0.01),
    "sink_m_s": (0.0, 0.01),
    "stall_m_s": (0.05, 0.0),
    "stall_drop_deg": (0.0, 0.1),
    "roll_rate_deg_s": (0.0, 0.02),
    "roll_rise_s": (TICK_S, 0.0),
    "pitch_rate_deg_s": (0.0, 0.03),
    "pitch_rise_s": (TICK_S, 0.0),
    "phugoid_s": (0.0, 0.02),
    "phugoid_left": (0.03, 0.0),
    "turn_radius_m": (0.0, 0.02),
    "turn_slip_deg": (0.1, 0.0),
}


def trim(name, model):
    flight = launched(name, model)
    flight.advance(30.0)
    state = flight.state
    return {"trim_m_s": state.airspeed_m_s, "trim_pitch_deg": state.pitch_deg}


def level_throttle(name, model):
    """Between two throttles at the attitude of level cruise, by their climb rates."""
    pitch_deg = load_airframe(name).navigation["performance"]["cruise_pitch_deg"]
    climbs = []
    for share in (0.4, 0.6):
        flight = launched(name, model, throttle=share)
        for _ in range(600):
            state = flight.state
            throttle_us = 1000 + 1000 * share
            move(flight, wings_level(state), hold_pitch(state, pitch_deg), throttle_us)
            flight.advance(TICK_S)
        climbs.append(flight.state.climb_m_s)
    slow, fast = climbs
    assert slow < 0 < fast
    return {"level_throttle": 0.4 + 0.2 * slow / (slow - fast)}


def best_glide(name, model):
    found = glide(name, BEST_GLIDE_US[name], 20.0, model)
    return {"glide_ratio": found.ratio, "sink_m_s": found.sink_m_s}


def broken_lift(name, model):
    """The speed of the stall, and how far the nose falls with the elevator held up."""
    flight = launched(name, model)
    highest, drop, elevator = -90.0, 0.0, 0.0
    for _ in range(1000):
        elevator = min(500.0, elevator + 3.0)
        move(flight, wings_level(flight.state), elevator)
        flight.advance(TICK_S)
        highest = max(highest, flight.state.pitch_deg)
        drop = max(drop, highest - flight.state.pitch_deg)
    return {"stall_m_s": stall(name, model), "stall_drop_deg": drop}


def rates(name, model):
    """The greatest rate after a step, and when two thirds of it are reached."""
    found = {}
    for axis, sticks in (("roll", {"ailerons": 500.0}), ("pitch", {"elevator": 200.0})):
        flight = launched(name, model)
        move(flight, **sticks)
        seen = []
        for _ in range(40):
            flight.advance(TICK_S)
            seen.append(getattr(flight.state, f"{axis}_rate_deg_s"))
        rise = next(at for at, rate in enumerate(seen) if rate > max(seen) * 2 / 3)
        found |= {f"{axis}_rate_deg_s": max(seen), f"{axis}_rise_s": rise * TICK_S}
    return found


def phugoid(name, model):
    cruise_m_s = load_airframe(name).launch.airspeed_m_s
    flight = launched(name, model, airspeed_m_s=cruise_m_s + 1.5)
    speeds = [each.airspeed_m_s for each in fly(flight, 40.0)]
    (first, high), (second, lower) = peaks(speeds[100:])[:2]
    left = (lower - speeds[-1]) / (high - speeds[-1])
    return {"phugoid_s": (second - first) * TICK_S, "phugoid_left": left}


def turn(name, model):
    """A bank of 30 degrees, the elevator at rest."""
    flight = launched(name, model, roll_deg=30.0)
    for _ in range(1000):
        state = flight.state
        demand = 4.0 * (30.0 - state.roll_deg) - 2.0 * state.roll_rate_deg_s
        move(flight, max(-400.0, min(400.0, demand)), 60.0)
        flight.advance(TICK_S)
    before = flight.state
    flight.advance(1.0)
    state = flight.state
    turned = math.radians((state.yaw_deg - before.yaw_deg) % 360.0)
    radius_m = state.airspeed_m_s / turned
    return {"turn_radius_m": radius_m, "turn_slip_deg": state.sideslip_deg}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    "measure", [trim, level_throttle, best_glide, broken_lift, rates, phugoid, turn]
)
def test_it_flies_as_jsbsim_does(name, measure):
    built_in, jsbsim = measure(name, "built-in"), measure(name, "jsbsim")
    for quality, found in built_in.items():
        absolute, share = LIMITS[quality]
        print(f"{name} {quality} {found:.4g} {jsbsim[quality]:.4g}")
        assert found == pytest.approx(jsbsim[quality], abs=absolute, rel=share), quality


STATES = [
    (u, v, w, rates)
    for u, v, w in (
        (11.0, 0.0, 0.1), (11.0, 3.0, 0.5), (20.0, -4.0, -3.0), (5.0, 0.5, 2.0), (2.0, 6.0, 9.0),
        (-8.0, 1.0, 2.0), (9.0, -1.0, 1.9),
    )
    for rates in ((0.0, 0.0, 0.0), (1.5, -0.7, 0.9))
]  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_the_accelerations_are_jsbsims_in_any_flow(name):
    """Attached and stalled, in sideslip and backwards, turning, with moved surfaces and power."""
    found = [
        [_accelerations(name, model, *state) for state in STATES]
        for model in ("built-in", "jsbsim")
    ]
    for state, built_in, jsbsim in zip(STATES, *found, strict=True):
        scale = max(abs(each) for each in jsbsim[:3])
        assert built_in[:3] == pytest.approx(jsbsim[:3], rel=0.005, abs=0.002 * scale), state
        assert built_in[3:] == pytest.approx(jsbsim[3:], rel=0.005, abs=0.01), state


def _accelerations(name, model, u, v, w, rates):
    """Specific force (m/s2) and turning (rad/s2) after one step, too short to change the flow."""
    fdm = load_model(load_airframe(name).model_path, 1e-5, model)
    for axis, speed in zip("uvw", (u, v, w), strict=True):
        fdm[f"ic/{axis}-fps"] = speed / FOOT_M
    for axis, rate in zip("pqr", rates, strict=True):
        fdm[f"ic/{axis}-rad_sec"] = rate
    fdm["ic/h-sl-ft"], fdm["ic/lat-geod-deg"] = 370.0 / FOOT_M, 50.0
    fdm["ic/phi-deg"], fdm["ic/theta-deg"], fdm["ic/psi-true-deg"] = 25.0, -10.0, 130.0
    fdm.run_ic()
    for surface, angle in (("left-aileron", 0.1), ("right-aileron", -0.2), ("elevator", -0.1)):
        fdm[f"fcs/{surface}-pos-rad"] = angle
    fdm["fcs/rudder-pos-rad"], fdm["external_reactions/motor/magnitude"] = 0.15, 0.5
    for _ in range(3):
        fdm.run()
    force = [fdm[f"accelerations/a-pilot-{axis}-ft_sec2"] * FOOT_M for axis in "xyz"]
    return force + [fdm[f"accelerations/{axis}dot-rad_sec2"] for axis in "pqr"]


@pytest.mark.parametrize("wind_from_deg", [200.0])
def test_a_flight_of_many_moves_ends_where_jsbsims_ends(wind_from_deg):
    """Rolls, pulls, power and rudder in wind, open loop: 10 s without a correction."""
    ends = []
    for model in ("built-in", "jsbsim"):
        weather = Weather(wind_m_s=5.0, wind_from_deg=wind_from_deg)
        start = Start(heading_deg=70.0, roll_deg=-20.0, yaw_rate_deg_s=10.0)
        flight = FlightDynamics(load_airframe("glider"), start, weather, model=model)
        for tick in range(20):
            sticks = (80 * (tick % 5 == 1), -60 * (tick % 7 == 3), 30 * tick, 50 * (tick % 3 == 0))
            neutral = (1500, 1500, 1000, 1500)
            flight.set_servos(
                tuple(each + move for each, move in zip(neutral, sticks, strict=True))
            )
            flight.advance(0.5)
        ends.append((flight.state, flight.motion))
    (state, motion), (other, felt) = ends
    assert math.dist((state.north_m, state.east_m), (other.north_m, other.east_m)) < 0.3
    for name, limit in (
        ("height_m", 0.1), ("roll_deg", 0.3), ("pitch_deg", 0.2), ("yaw_deg", 0.5),
        ("airspeed_m_s", 0.05), ("speed_m_s", 0.05), ("climb_m_s", 0.05), ("alpha_deg", 0.05),
        ("sideslip_deg", 0.1), ("load_factor_g", 0.01), ("latitude_deg", 4e-6),
        ("longitude_deg", 5e-6), ("wind_north_m_s", 1e-6), ("wind_east_m_s", 1e-6),
    ):  # fmt: skip
        assert getattr(state, name) == pytest.approx(getattr(other, name), abs=limit), name
    for name in motion.__slots__:
        assert getattr(motion, name) == pytest.approx(getattr(felt, name), abs=0.5), name


def test_turbulence_has_the_deviations_of_the_standard():
    """MIL-F-8785C at 300 ft in a wind of 30 ft/s at 20 ft; 400 s of it."""
    turbulence = DrydenTurbulence(6.0, 0.02, 1)
    rows = [turbulence.step(200.0, 300.0, 30.0) for _ in range(20000)]
    along, across, down, roll, *_ = (
        math.sqrt(sum(each * each for each in column) / len(rows))
        for column in zip(*rows, strict=True)
    )
    horizontal = 3.0 / (0.177 + 0.000823 * 300.0) ** 0.4
    assert down == pytest.approx(3.0, rel=0.1)
    assert along == pytest.approx(horizontal, rel=0.15)
    assert across == pytest.approx(horizontal, rel=0.15)
    assert roll == pytest.approx(1.9 / math.sqrt(300.0 * 6.0) * 3.0, rel=0.1)
    again, other = DrydenTurbulence(6.0, 0.02, 1), DrydenTurbulence(6.0, 0.02, 2)
    assert again.step(200.0, 300.0, 30.0) == rows[0] != other.step(200.0, 300.0, 30.0)


def test_turbulence_moves_the_aircraft_and_only_where_it_is_asked_for():
    states = []
    for level in ("none", "severe"):
        weather = Weather(turbulence=level)
        flight = FlightDynamics(load_airframe("glider"), None, weather, model="built-in")
        flight.advance(2.0)
        states.append(flight.state)
    calm, rough = states
    assert calm.roll_deg == calm.wind_down_m_s == 0.0
    assert abs(rough.roll_deg) > 0.1 and rough.wind_down_m_s != 0.0
    # The air turns, too.
    turned = [flight._fdm[f"velocities/{axis}-aero-rad_sec"] for axis in "pqr"]
    rates = [flight._fdm[f"velocities/{axis}-rad_sec"] for axis in "pqr"]
    assert all(abs(air - rate) > 1e-4 for air, rate in zip(turned, rates, strict=True))


def test_a_diverged_model_is_a_crash():
    flight = launched("glider", "built-in")
    flight._fdm["fcs/elevator-pos-rad"] = math.nan
    flight._moves.clear()
    flight.advance(1.0)
    assert flight.crash is not None


def test_without_jsbsim_the_built_in_model_flies(monkeypatch):
    assert chosen_model("auto") == "jsbsim"
    monkeypatch.setitem(sys.modules, "jsbsim", None)
    assert chosen_model("auto") == "built-in"
    assert launched("glider").model == "built-in"
    with pytest.raises(FlightUnavailableError):
        launched("glider", "jsbsim")


@pytest.mark.parametrize(
    ("here", "there", "named"),
    [
        ("<metrics>", "<metrics><htailarea/>", "htailarea"),
        ("<sin>", "<tan>", "tan"),
        ("</sin>", "</sin><value>x</value>", "x"),
        ("fcs/rudder-pos-rad", "fcs/flap-pos-norm", "fcs/flap-pos-norm"),
        ('name="motor"', 'name="jet"', "jet"),
        ("<x>0.08</x>", "<x>0.09</x>", "centre of gravity"),
        ('unit="KG*M2"', 'unit="SLUG*FT2"', "ixx"),
        ("<independentVar>", '<independentVar lookup="row">a</independentVar><independentVar>',
         "variable"),
        ("</fdm_config>", "", "no element"),
        ('<emptywt unit="KG">', '<emptywt unit="KG">1,', "the number '1,"),
        ('<emptywt unit="KG">', '<emptywt unit="KG">-', "emptywt of -"),
    ],
)  # fmt: skip
def test_what_only_jsbsim_supports_is_named(tmp_path, here, there, named):
    text = load_airframe("glider").model_path.read_text(encoding="utf-8")
    assert here in text
    path = tmp_path / "other.xml"
    changed = text.replace(here, there, 1)
    if here == "<sin>":
        changed = changed.replace("</sin>", "</tan>", 1)
    path.write_text(changed, encoding="utf-8")
    with pytest.raises(FlightUnavailableError) as error:
        BuiltInModel(path, 0.002)
    assert named in str(error.value) and str(path) in str(error.value)
    assert "\n" not in str(error.value)
