"""The flight in two sentences."""

from __future__ import annotations

from collections.abc import Sequence

from black_box_cog.report.finding_groups import groups_of, worst_of
from black_box_cog.report.formatting import clock_text
from up.flight_log.spans import duration_text
from up.flight_log.summary import Finding, FlightSummary

LEVELS = {"alarm": "bad", "warning": "warning", "info": "info"}
"""A level of a fault, as a CSS class of the page."""


def verdict_of(summary: FlightSummary, findings: Sequence[Finding]) -> tuple[str, str]:
    """Return ``good``, ``warning`` or ``bad``, and the sentences."""
    kinds = [each.worst for each in groups_of(findings)]
    alarms = [each for each in kinds if each.level == "alarm"]
    warnings = [each for each in kinds if each.level == "warning"]
    if alarms:
        worst = worst_of(alarms)
        told = f"The worst, at {clock_text(worst.time_s)}: {worst.text}."
        return "bad", f"{_flight(summary)} {_counted(alarms, warnings)} {told}"
    if warnings:
        looks = f"{_things(len(warnings))} {_deserve(len(warnings))} a look"
        return "warning", f"{_flight(summary)} Nothing dangerous went wrong; {looks}."
    return "good", f"{_flight(summary)} Nothing went wrong that the log can tell."


def _flight(summary: FlightSummary) -> str:
    length = duration_text(summary.length_s)
    if not summary.armed:
        return f"{length} were recorded; the aircraft was never armed."
    armed_s = sum(span.length_s for span in summary.armed)
    flown = (
        "all of it armed"
        if armed_s >= 0.99 * summary.length_s
        else (f"{duration_text(armed_s)} of it armed")
    )
    reached = "" if summary.farthest_m is None else f", up to {summary.farthest_m:.0f} m from home"
    return f"{length} were recorded, {flown}{reached}."


def _counted(alarms: Sequence[Finding], warnings: Sequence[Finding]) -> str:
    text = f"{_things(len(alarms))} went wrong"
    if warnings:
        text += f", and {_number(len(warnings))} more {_deserve(len(warnings))} a look"
    return f"{text[0].upper()}{text[1:]}."


def _things(count: int) -> str:
    return f"{_number(count)} {'thing' if count == 1 else 'things'}"


def _deserve(count: int) -> str:
    return "deserves" if count == 1 else "deserve"


def _number(count: int) -> str:
    words = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
    return words[count] if count < len(words) else str(count)
