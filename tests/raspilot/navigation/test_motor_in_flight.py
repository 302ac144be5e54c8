"""A motor that stops silently in LOITER: the firmware flies what the path controller demands."""

import functools
import math
from typing import NamedTuple

import pytest

from raspilot.navigation.estimator import Estimator
from raspilot.navigation.path_controller import PathController
from raspilot.navigation.planning import circle_abeam
from tests.raspilot.navigation.recordings import PHONE_PERIOD_S, booted, fix_of, rms
from tests.simulator.flying import BEAT_S
from up.commands.board_status import forward_m_s2_of
from up.flight_modes.demand import PathDemand
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import NavigationState
from up_simulator.aircraft.flight import FlightState
from up_simulator.phone.sensors import PhoneSensors
from up_simulator.radio.circling_pilot import CirclingPilot

CONFIG = NavigationConfig()
BEGIN_S = 12.0


class Step(NamedTuple):
    time_s: float
    truth: FlightState
    state: NavigationState


@functools.cache
def loiter(seed, wind_m_s, turbulence, duration_s, stops_s=math.inf):
    """Circle at constant altitude from ``BEGIN_S`` on, steered by the estimate."""
    flown = booted(seed, wind_m_s, turbulence)
    board, dynamics = flown.board, flown.dynamics
    estimator, controller = Estimator(), PathController(CONFIG)
    pilot, phone = CirclingPilot(switch="FBW"), PhoneSensors(seed)
    demand, status, steps = None, None, []
    for beat in range(round(duration_s / BEAT_S)):
        time_s = beat * BEAT_S
        state = estimator.state()
        if time_s < BEGIN_S:
            sticks = pilot.sticks(time_s, dynamics.state)
            pulses = sticks.ailerons, sticks.elevator, sticks.throttle
        else:
            demand = demand or PathDemand(circle_abeam(CONFIG, state, 50.0), state.altitude_m)
            wanted = controller.step(demand, state, BEAT_S)
            pulses = (
                round(1500 + 500 * wanted.roll_deg / 50),
                round(1500 + 500 * wanted.pitch_deg / 25),
                round(1000 + 1000 * wanted.throttle),
            )
        for channel, pulse_us in zip(("ailerons", "elevator", "throttle"), pulses, strict=True):
            board.set_stick(channel, pulse_us)
        for channel, pulse_us in {"rudder": 1500, "aux1": 1500, "aux2": 2000}.items():
            board.set_stick(channel, pulse_us)
        dynamics.motor_works = time_s < stops_s
        flown.fly(BEAT_S)
        told, now_s = flown.tap.orientation, flown.world.time_s
        if told is None:
            continue
        estimator.throttle((board.pulses_us()[2] - 1000) / 1000)
        estimator.orientation(now_s, told.roll_deg, told.pitch_deg, told.yaw_deg)
        if flown.tap.status is not status:
            status = flown.tap.status
            estimator.acceleration(now_s, forward_m_s2_of(status))
        if beat % round(PHONE_PERIOD_S / BEAT_S) == 0:
            data = phone.location(dynamics.state)
            if data:
                estimator.fix(fix_of(data, now_s), now_s)
            if beat % 10 == 0:
                estimator.barometer(now_s, phone.altitude(dynamics.state)["altitude"])
        if time_s > BEGIN_S:
            steps.append(Step(now_s, dynamics.state, estimator.state()))
    return steps


@pytest.mark.parametrize(
    ("seed", "wind_m_s", "turbulence", "allowed_s"), [(75, 0, "none", 3.0), (7, 6, "moderate", 3.0)]
)
def test_a_stop_is_seen_and_the_airspeed_stays(seed, wind_m_s, turbulence, allowed_s):
    steps = loiter(seed, wind_m_s, turbulence, 115, 95.0)
    after = [each for each in steps if each.time_s > 95.0]
    seen_s = next(each.time_s for each in after if each.state.motor_stopped)
    assert seen_s - 95.0 < allowed_s
    assert all(each.state.motor_stopped for each in after if each.time_s > seen_s)
    stall_m_s = CONFIG.airspeed.stall_m_s
    assert min(each.truth.airspeed_m_s for each in after) > 1.1 * stall_m_s
    gliding = [each for each in after if each.time_s > seen_s + 2.0]
    assert rms(each.state.airspeed_m_s - each.truth.airspeed_m_s for each in gliding) < 1.5


@pytest.mark.parametrize(("seed", "until_s"), [(7, 95.0), (8, 60.0)])
def test_turbulence_alone_is_no_stop(seed, until_s):
    ends = (115, 95.0) if seed == 7 else (until_s,)
    steps = [each for each in loiter(seed, 6, "moderate", *ends) if each.time_s < until_s]
    assert not any(each.state.motor_stopped for each in steps)
