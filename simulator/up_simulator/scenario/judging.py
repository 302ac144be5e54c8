"""Whether an expectation held, and by which figure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from up_simulator.scenario.expectation import Expectation
from up_simulator.scenario.log import FlightLog
from up_simulator.scenario.measures import MEASURES, limit_text
from up_simulator.scenario.step import judge_step
from up_simulator.scenario.verdict import Verdict
from up_simulator.scenario.window import NoWindowError, Window, window_of


@dataclass(frozen=True, slots=True)
class FlightFacts:
    """Input of the evaluation: the log, the times of the events, the planned duration, a crash."""

    log: FlightLog
    event_times: Mapping[str, float]
    duration_s: float
    crash_s: float | None = None
    may_crash: bool = False


def judge(expectation: Expectation, facts: FlightFacts) -> Verdict:
    """Return the verdict on one expectation."""
    try:
        window = window_of(expectation, facts.log, facts.event_times, facts.duration_s)
    except NoWindowError as error:
        has_crashed = facts.crash_s is not None
        figure = f"crashed at {facts.crash_s:.2f} s" if has_crashed else "none"
        limit = limit_text(expectation)
        return Verdict(expectation.name, False, figure, limit, str(error), has_crashed)
    verdict = _measure(expectation, window, facts.log)
    if verdict.is_held and window.is_cut and not facts.may_crash and not _is_done(expectation):
        why = f"the flight ended at {window.times_s[-1]:.2f} s, inside the window"
        return replace(verdict, is_held=False, why=why)
    return verdict


def _measure(expectation: Expectation, window: Window, log: FlightLog) -> Verdict:
    if expectation.step is not None:
        return judge_step(expectation, expectation.step, window, log)
    return MEASURES[expectation.kind](expectation, window)


def _is_done(expectation: Expectation) -> bool:
    """Return whether an expectation that held once cannot fail later."""
    return expectation.kind in ("becomes", "becomes_below", "becomes_above", "changes_above")
