"""Recorded flights of the simulated glider with the firmware, replayed to the estimator."""

import functools
import math
from dataclasses import dataclass

from raspilot.navigation.estimator import Estimator
from raspilot.navigation.fix_gate import Fix
from tests.simulator.flying import BEAT_S, Flown
from up_simulator.aircraft import FlightDynamics, Start, Weather
from up_simulator.aircraft.flight import FlightState
from up_simulator.firmware.imu_errors import drawn_errors
from up_simulator.harness.world import World
from up_simulator.phone.sensors import PhoneSensors
from up_simulator.radio.circling_pilot import CirclingPilot

PHONE_PERIOD_S = 0.1


@dataclass(frozen=True, slots=True)
class Frame:
    """What the board has sent within 20 ms, and the truth then."""

    time_s: float
    roll_deg: float
    pitch_deg: float
    yaw_deg: float
    throttle: float
    truth: FlightState


def circles(time_s, state):
    return None


def mixed(time_s, state):
    """Circles, then straight legs, a turn to the other side, full throttle and a glide."""
    if time_s < 70:
        return None
    if time_s < 110:
        return {"course": 30}
    if time_s < 120:
        return {"bank": -25}
    if time_s < 150:
        return {"course": 250, "throttle": 1750}
    if time_s < 165:
        return {"course": 250, "throttle": 1000, "pitch": -3}
    return {"course": 100}


def booted(seed, wind_m_s, turbulence):
    flown = Flown(
        seed=seed, kind="host", boots=False,
        errors=drawn_errors(seed, vibration_deg_s=1, vibration_m_s2=1),
    )  # fmt: skip
    weather = Weather(wind_m_s, 270.0, turbulence)
    flown.dynamics = FlightDynamics(flown.airframe, Start(height_m=150), weather, seed)
    flown.world = World(flown.dynamics, flown.board)
    flown.world.boot(arms=True)
    flown.listen()
    return flown


@functools.cache
def record(plan, duration_s, wind_m_s=0.0, turbulence="none", seed=1):
    """Fly once; the pilot circles unless the plan knows better."""
    flown = booted(seed, wind_m_s, turbulence)
    world, dynamics = flown.world, flown.dynamics
    pilot = CirclingPilot(switch="FBW")
    frames = []
    for beat in range(round(duration_s / BEAT_S)):
        time_s, state = beat * BEAT_S, dynamics.state
        _steer(flown.board, pilot.sticks(time_s, state), plan(time_s, state), state)
        flown.fly(BEAT_S)
        told = flown.tap.orientation
        if told is not None:
            throttle = (flown.board.pulses_us()[2] - 1000) / 1000
            angles = told.roll_deg, told.pitch_deg, told.yaw_deg
            frames.append(Frame(world.time_s, *angles, throttle, dynamics.state))
    assert dynamics.crash is None
    return frames


def _steer(board, sticks, plan, state):
    pulses = {"ailerons": sticks.ailerons, "elevator": sticks.elevator}
    plan = plan or {}
    if "course" in plan:
        off_deg = (plan["course"] - state.track_deg + 180) % 360 - 180
        plan["bank"] = max(-25.0, min(25.0, 0.7 * off_deg))
    if "bank" in plan:
        pulses["ailerons"] = round(1500 + 500 * plan["bank"] / 50)
    if "pitch" in plan:
        pulses["elevator"] = round(1500 + 500 * plan["pitch"] / 25)
    pulses["throttle"] = plan.get("throttle", sticks.throttle)
    for channel, pulse_us in {**pulses, "rudder": 1500, "aux1": 1500, "aux2": 2000}.items():
        board.set_stick(channel, pulse_us)


class Flight:
    """A recording and a phone, replayed through an estimator; ``estimates`` are of every frame.

    ``change`` may replace a fix by another one or by None.
    """

    def __init__(self, frames, *, seed=1, change=lambda fix: fix, barometer=False, **airframe):
        self.estimator = estimator = Estimator(**airframe)
        self.frames = frames
        self.estimates = []
        phone = PhoneSensors(seed)
        for turn, frame in enumerate(frames):
            estimator.throttle(frame.throttle)
            angles = frame.roll_deg, frame.pitch_deg, frame.yaw_deg
            estimator.orientation(frame.time_s, *angles)
            if turn % round(PHONE_PERIOD_S / BEAT_S) == 0:
                data = phone.location(frame.truth)
                fix = data and change(fix_of(data, frame.time_s))
                if fix:
                    estimator.fix(fix, frame.time_s)
                if barometer and turn % 10 == 0:
                    estimator.barometer(frame.time_s, phone.altitude(frame.truth)["altitude"])
            self.estimates.append(estimator.state())

    def pairs(self, from_s, to_s=math.inf):
        """Return the estimates of a time, each with the truth."""
        return [
            (estimate, frame.truth)
            for frame, estimate in zip(self.frames, self.estimates, strict=True)
            if from_s <= frame.time_s < to_s
        ]


def fix_of(data, now_s):
    return Fix(
        now_s - data["age_ms"] / 1000, data["latitude"], data["longitude"], data["altitude"],
        data["accuracy"], data["speed"], data["bearing"],
    )  # fmt: skip


def off_m(estimate, truth):
    """Return the distance between estimated and true position."""
    true = estimate.frame.point(truth.latitude_deg, truth.longitude_deg)
    return math.dist(true, estimate.position)


def rms(values):
    values = list(values)
    return math.sqrt(sum(each * each for each in values) / len(values))
