"""The short flights that evaluate gains: steps, the loop's response, rough air."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean

from tools.tuning.gain_set import CHANNELS, Axis
from tools.tuning.margins import LoopPoint, MarginsError, Multisine, loop_response
from tools.tuning.trial import Recording, StickMove, Trial
from up.commands.flight_state_command import DEFAULT_LIMITS_DEG
from up.commands.gains import GainSet
from up_simulator.aircraft import Airframe, Weather
from up_simulator.firmware.board import BoardKind
from up_simulator.harness.world import STEP_S
from up_simulator.scenario.step_response import StepError, StepResponse, analyse_step

SETTLE_S = 4.0
DIVE_DEG = -20.0
DIVE_SETTLE_S = 9.0


@dataclass(frozen=True, slots=True)
class Bench:
    """Everything of a trial but the gains."""

    airframe: Airframe
    board: BoardKind = "auto"
    seed: int = 1

    def trial(self, gains: GainSet, weather: Weather | None = None, seed: int = 0) -> Trial:
        return Trial(
            self.airframe, gains, board=self.board, weather=weather, seed=seed or self.seed
        )


@dataclass(frozen=True, slots=True)
class StepPlan:
    """Demands in a row, deg, that an axis is to follow in FBW, each for the same time."""

    axis: Axis
    demands: tuple[float, ...]
    hold_s: float

    @property
    def signal(self) -> str:
        return f"truth.{self.axis}_deg"

    @property
    def duration_s(self) -> float:
        return SETTLE_S + self.hold_s * len(self.demands)


STEPS: dict[Axis, StepPlan] = {
    "roll": StepPlan("roll", (30.0, 0.0, -30.0, 0.0), 3.0),
    "pitch": StepPlan("pitch", (10.0, 0.0, -10.0, 0.0), 3.0),
}


@dataclass(frozen=True, slots=True)
class FlownSteps:
    """The responses to the steps of a plan; a step that cannot be measured is left out."""

    plan: StepPlan
    responses: tuple[StepResponse, ...]
    recording: Recording

    @property
    def crash(self) -> str | None:
        return self.recording.crash

    @property
    def rise_time_s(self) -> float | None:
        """Return the mean rise time; ``None`` when one step never rose."""
        return _mean([each.rise_time_s for each in self.responses])

    @property
    def settling_time_s(self) -> float | None:
        """Return the mean settling time; ``None`` when one step never settled."""
        return _mean([each.settling_time_s for each in self.responses])

    @property
    def overshoot_percent(self) -> float:
        return fmean([each.overshoot_percent for each in self.responses] or [math.inf])

    @property
    def steady_error_percent(self) -> float:
        """Return the mean absolute error at the end of a step, percent of the step."""
        return fmean([abs(each.steady_error_percent) for each in self.responses] or [math.inf])


def fly_steps(
    bench: Bench, gains: GainSet, plan: StepPlan, weather: Weather | None = None
) -> FlownSteps:
    """Fly the steps of a plan and measure the responses."""
    trial = bench.trial(gains, weather)
    channel = CHANNELS[plan.axis]
    moves = []
    for number, demand in enumerate(plan.demands):
        at_s = SETTLE_S + number * plan.hold_s
        moves.append(StickMove(at_s, channel, stick_us(bench.airframe, plan.axis, demand)))
    recording = trial.fly(plan.duration_s, moves)
    times_s, values = recording.times_s, recording[plan.signal]
    responses = []
    for number, demand in enumerate(plan.demands):
        at_s = SETTLE_S + number * plan.hold_s
        before = plan.demands[number - 1] if number else 0.0
        try:
            responses.append(
                analyse_step(times_s, values, at_s, before, demand, at_s + plan.hold_s - 1e-6)
            )
        except StepError:
            continue
    return FlownSteps(plan, tuple(responses), recording)


def stick_us(airframe: Airframe, axis: Axis, demand: float) -> float:
    name = "roll_deg" if axis == "roll" else "pitch_up_deg"
    if axis == "pitch" and demand < 0:
        name = "pitch_down_deg"
    limits: dict[str, float] = {**DEFAULT_LIMITS_DEG, **(airframe.profile.get("fly_by_wire") or {})}
    return 1500.0 + 500.0 * max(-1.0, min(1.0, demand / limits[name]))


def measure_loop(
    bench: Bench,
    gains: GainSet,
    axis: Axis,
    *,
    dives: bool = False,
    periods: int = 4,
    delay_s: float = 0.0,
) -> tuple[list[LoopPoint], float]:
    """Return the open loop of an axis in FBW and the airspeed of the measurement, m/s.

    A sum of sines is added between board and servos. ``dives``: with the nose 20 degrees down, at
    the resulting speed. Raises ``MarginsError``.
    """
    trial = bench.trial(gains)
    moves = []
    if dives:
        moves = [StickMove(0.5, "elevator", stick_us(bench.airframe, "pitch", DIVE_DEG))]
    trial.fly(DIVE_SETTLE_S if dives else SETTLE_S, moves)
    multisine = Multisine()
    dynamics = trial.dynamics
    begin_s = dynamics.time_s
    dynamics.delay_s = delay_s
    dynamics.added_axis = axis
    dynamics.added_us = lambda time_s: multisine.at(time_s - begin_s)
    given: list[float] = []
    moved: list[float] = []

    def on_step(by_board: dict[Axis, float], at_servos: dict[Axis, float]) -> None:
        given.append(by_board[axis])
        moved.append(at_servos[axis])

    dynamics.on_step = on_step
    recording = trial.fly(multisine.period_s * periods, sample_s=0.1)
    if dynamics.crash is not None:
        raise MarginsError(f"the aircraft {dynamics.crash}", "crashed")
    speed_m_s = fmean(recording["truth.airspeed_m_s"])
    return loop_response(given, moved, multisine, STEP_S), speed_m_s


@dataclass(frozen=True, slots=True)
class RoughFlight:
    """Steadiness in rough air: rms of the errors at a demand of level flight."""

    roll_rms_deg: float
    pitch_rms_deg: float
    yaw_rate_rms_deg_s: float
    crash: str | None


def fly_rough(bench: Bench, gains: GainSet, seconds: float, seeds: Sequence[int]) -> RoughFlight:
    """Hold level in moderate turbulence, once for each seed of the air."""
    sums = [0.0] * 3
    count = 0
    crash = None
    for seed in seeds:
        trial = bench.trial(gains, Weather(turbulence="moderate"), seed)
        trial.fly(SETTLE_S)
        recording = trial.fly(seconds)
        crash = crash or recording.crash
        names = ("roll_deg", "pitch_deg", "yaw_rate_deg_s")
        for at, name in enumerate(names):
            sums[at] += sum(value * value for value in recording[f"truth.{name}"])
        count += len(recording.times_s)
    roll, pitch, yaw_rate = (math.sqrt(each / max(1, count)) for each in sums)
    return RoughFlight(roll, pitch, yaw_rate, crash)


def yaw_swing(bench: Bench, gains: GainSet) -> float:
    """Return the yaw rate that is left after a kick of the rudder, rms, deg/s.

    The rudder stick goes right for 0.3 s; the rate is measured for 3 s after that, less its mean.
    """
    trial = bench.trial(gains)
    kick = [
        StickMove(SETTLE_S, "rudder", 1800.0),
        StickMove(SETTLE_S + 0.3, "rudder", 1500.0),
    ]
    recording = trial.fly(SETTLE_S + 3.5, kick)
    after = [
        rate
        for time_s, rate in zip(recording.times_s, recording["truth.yaw_rate_deg_s"], strict=True)
        if time_s >= SETTLE_S + 0.5
    ]
    if not after:
        return math.inf
    mean = fmean(after)
    return math.sqrt(fmean([(rate - mean) ** 2 for rate in after]))


def _mean(values: Sequence[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return fmean(known) if known and len(known) == len(values) else None
