"""The verdict on a signal's response to a step of its demand."""

from __future__ import annotations

import math

from up_simulator.scenario.expectation import Expectation, StepLimits, Verdict, number_text
from up_simulator.scenario.log import FlightLog
from up_simulator.scenario.signals import signal_of
from up_simulator.scenario.step_response import StepError, StepResponse, analyse_step
from up_simulator.scenario.window import Window

MARGIN_S = 0.2
"""The demand is read this time before and after the step: the receiver and the mode need it."""
_LABELS = {
    "rise_time_s": ("rise", "s"),
    "overshoot_percent": ("overshoot", "%"),
    "settling_time_s": ("settled", "s"),
    "steady_error": ("steady error", ""),
}


def evaluate_step(
    expectation: Expectation, limits: StepLimits, window: Window, log: FlightLog
) -> Verdict:
    """Return the verdict on a step at the window's begin, measured until the window's end."""
    unit = signal_of(expectation.signal).unit
    limit_text = step_limit_text(limits, unit)
    try:
        start, end = _endpoints(expectation, limits, window, log)
        until_s = window.times_s[-1]
        response = analyse_step(
            *_with_lead(expectation.signal, window, log), window.begin_s, start, end, until_s
        )
    except StepError as error:
        return Verdict(expectation.name, False, "none", limit_text, str(error), False, "no_step")
    figures = {name: _figure(response, name) for name in limits.limits}
    text = ", ".join(
        f"{_LABELS[name][0]} never"
        if value is None
        else f"{_LABELS[name][0]} {number_text(value)} {_LABELS[name][1] or unit}".rstrip()
        for name, value in figures.items()
    )
    exceeded = [
        name
        for name, limit in limits.limits.items()
        if (value := figures[name]) is None or value > limit
    ]
    why = ", ".join(f"{_LABELS[name][0]} is beyond its limit" for name in exceeded)
    code = "out_of_limits" if exceeded else ""
    return Verdict(expectation.name, not exceeded, text, limit_text, why, code=code)


def step_limit_text(limits: StepLimits, unit: str) -> str:
    """Return the limits of a step as they read behind its figures."""
    return ", ".join(
        f"{_LABELS[name][0]} at most {number_text(limit)} {_LABELS[name][1] or unit}".rstrip()
        for name, limit in limits.limits.items()
    )


def _with_lead(name: str, window: Window, log: FlightLog) -> tuple[list[float], list[float]]:
    """Return the window with the time before it, which has the value before the step."""
    pairs = zip(log.numbers("time_s"), log.numbers(name), strict=True)
    begin_s, end_s = window.begin_s - 2 * MARGIN_S, window.times_s[-1]
    chosen = [(time_s, value) for time_s, value in pairs if begin_s <= time_s <= end_s]
    return [time_s for time_s, _ in chosen], [value for _, value in chosen]


def _figure(response: StepResponse, name: str) -> float | None:
    value: float | None = getattr(response, name)
    return abs(value) if name == "steady_error" and value is not None else value


def _endpoints(
    expectation: Expectation, limits: StepLimits, window: Window, log: FlightLog
) -> tuple[float, float]:
    start, end = limits.start, limits.end
    if start is not None and end is not None:
        return start, end
    demand = limits.demand or f"demand.{expectation.signal.partition('.')[2]}"
    if demand not in log:
        raise StepError(f"the log has no {demand}: set start and end", "no_demand")
    if start is None:
        start = _at(log, demand, window.begin_s - MARGIN_S)
    if end is None:
        end = _at(log, demand, window.begin_s + MARGIN_S)
    return start, end


def _at(log: FlightLog, name: str, time_s: float) -> float:
    newest = math.nan
    for row_s, value in zip(log.numbers("time_s"), log.numbers(name), strict=True):
        if row_s > time_s + 1e-6:
            break
        newest = value
    return newest
