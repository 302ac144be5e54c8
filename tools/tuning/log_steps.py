"""Finds the steps in a flight's log, measures them, and recommends changes in plain words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from tools.tuning.gain_set import Axis
from up_simulator.scenario.log import FlightLog
from up_simulator.scenario.step_response import StepError, StepResponse, analyse_step

MIN_STEP = {"deg": 5.0, "deg/s": 10.0}
QUICK_S = 0.25
"""A stick that takes longer to get there makes no step."""
LONGEST_S = 5.0
MIN_DURATION_S = 0.5
STEADY_S = 0.3
SAME = 0.1
"""The demand stays within this part of the step, otherwise it does not count as a step."""
_SIGNALS: tuple[tuple[Axis, str, str, str], ...] = (
    ("roll", "FBW", "roll_deg", "deg"),
    ("pitch", "FBW", "pitch_deg", "deg"),
    ("roll", "RATE", "roll_rate_deg_s", "deg/s"),
    ("pitch", "RATE", "pitch_rate_deg_s", "deg/s"),
)


class LogStepsError(Exception):
    """The log cannot be looked at: the message is one sentence."""


@dataclass(frozen=True, slots=True)
class LogStep:
    """A step of the demand in a flight, and its response."""

    axis: Axis
    mode: str
    at_s: float
    until_s: float
    start: float
    end: float
    unit: str
    response: StepResponse | None
    problem: str = ""
    """Why the response is missing."""


def steps_of(log: FlightLog, axes: Sequence[Axis] = ("roll", "pitch")) -> list[LogStep]:
    """Return every step of the demand in FBW and RATE, in order of time.

    The response is the aircraft's true attitude if the log has it, otherwise the board's estimate.
    Raises ``LogStepsError`` for a log without demands.
    """
    names = [each for each in _SIGNALS if each[0] in axes]
    if not any(f"demand.{name}" in log for _, _, name, _ in names):
        raise LogStepsError("the log has no demand.* columns: the demand is unknown")
    times_s = log.numbers("time_s")
    found: list[LogStep] = []
    for axis, mode, name, unit in names:
        if f"demand.{name}" not in log:
            continue
        values = _flown(log, name)
        if values is None:
            continue
        demands = log.numbers(f"demand.{name}")
        for at, past in _jumps(times_s, demands, MIN_STEP[unit]):
            found.append(_measured(axis, mode, unit, times_s, values, demands, at, past))
    return sorted(found, key=lambda step: (step.at_s, step.axis))


def _flown(log: FlightLog, name: str) -> list[float] | None:
    for source in ("truth", "board"):
        if f"{source}.{name}" in log:
            values = log.numbers(f"{source}.{name}")
            if any(math.isfinite(value) for value in values):
                return values
    return None


def _jumps(
    times_s: Sequence[float], demands: Sequence[float], least: float
) -> Iterator[tuple[int, int]]:
    """Yield the rows at which a step begins and at which its time ends."""
    at = 1
    while at < len(demands):
        arrived = _arrival(times_s, demands, at, least)
        if arrived is None:
            at += 1
            continue
        slack = SAME * abs(demands[arrived] - demands[at - 1])
        past = arrived
        while (
            past < len(demands)
            and abs(demands[past] - demands[arrived]) <= slack
            and times_s[past] - times_s[at] <= LONGEST_S
        ):
            past += 1
        if times_s[past - 1] - times_s[at] >= MIN_DURATION_S and _was_steady(
            times_s, demands, at, slack
        ):
            yield at, past
        at = max(past, at + 1)


def _arrival(
    times_s: Sequence[float], demands: Sequence[float], at: int, least: float
) -> int | None:
    """Return the row at which a step that begins at a row has ended, if one begins."""
    before = demands[at - 1]
    if not abs(demands[at] - before) > SAME * least:
        return None
    arrived = at
    while (
        arrived + 1 < len(demands)
        and times_s[arrived + 1] - times_s[at] <= QUICK_S
        and abs(demands[arrived + 1] - before) > abs(demands[arrived] - before)
    ):
        arrived += 1
    return arrived if abs(demands[arrived] - before) >= least else None


def _was_steady(times_s: Sequence[float], demands: Sequence[float], at: int, slack: float) -> bool:
    """Return whether the demand stood still before a step."""
    first = at - 1
    while first > 0 and times_s[at] - times_s[first] < STEADY_S:
        first -= 1
    part = demands[first:at]
    return all(abs(demand - part[-1]) <= slack for demand in part)


def _measured(
    axis: Axis,
    mode: str,
    unit: str,
    times_s: Sequence[float],
    values: Sequence[float],
    demands: Sequence[float],
    at: int,
    past: int,
) -> LogStep:
    start, end = demands[at - 1], demands[past - 1]
    step = (axis, mode, times_s[at], times_s[past - 1], start, end, unit)
    first = at
    while first > 0 and times_s[at] - times_s[first] < STEADY_S:
        first -= 1
    try:
        response = analyse_step(times_s[first:past], values[first:past], times_s[at], start, end)
    except StepError as error:
        return LogStep(*step, None, str(error))
    return LogStep(*step, response)


ADVICE = {
    "not_following": "it does not follow the demand; look at the direction of the servo, at the"
    " mode and at the airspeed before any gain",
    "rings": "it rings: lower the rate P by a third first, and the stabilize P if that is not"
    " enough",
    "overshoots": "it overshoots: lower the stabilize P by a quarter, or raise the rate P a little",
    "short": "it falls short of the demand: raise the stabilize P, then the rate P; more throttle"
    " where it sinks below its speed",
    "slow": "it is slow and calm: raise the stabilize P by a quarter and fly the steps again",
    "good": "it follows well; leave it",
    "rate_rings": "it rings: lower the rate P by a third",
    "rate_short": "it turns slower than demanded, as every rate P without I does; a higher rate P"
    " lessens it, within the margins that 'up-sim tune' shows; FBW needs none of it",
    "rate_overshoots": "it begins faster than it continues: a property of the aeroplane, leave it",
}


def advice(steps: Sequence[LogStep]) -> dict[tuple[Axis, str], str]:
    """Return a code of ``ADVICE`` for each axis and mode that was flown."""
    found: dict[tuple[Axis, str], str] = {}
    for axis, mode, _, _ in _SIGNALS:
        chosen = [
            step.response
            for step in steps
            if (step.axis, step.mode) == (axis, mode) and step.response is not None
        ]
        if chosen:
            found[axis, mode] = _advice(mode, chosen)
    return found


def _advice(mode: str, responses: Sequence[StepResponse]) -> str:
    half = len(responses) / 2
    rings = sum(each.swings > 3 for each in responses) > half
    over = sum(each.overshoot_percent > 15 for each in responses) > half
    # A step back to level never falls short, and half of the steps of a flight are such.
    short = 2 * sum(each.steady_error_percent > 10 for each in responses) >= len(responses)
    if sum(each.rise_time_s is None for each in responses) > half:
        return "not_following"
    if mode == "RATE":
        faults = {"rate_rings": rings, "rate_short": short, "rate_overshoots": over}
    else:
        slow = sum((each.rise_time_s or 9.0) > 1.2 for each in responses) > half
        faults = {"rings": rings, "overshoots": over, "short": short, "slow": slow}
    return next((code for code, is_true in faults.items() if is_true), "good")
