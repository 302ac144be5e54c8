"""Findings grouped by kind, however many there are, and the flight in two sentences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from up_flightlog.findings.finding import Finding
from up_flightlog.findings.summary import FlightSummary
from up_flightlog.read.spans import duration_text
from up_flightlog.report.formatting import clock_text

MOMENTARY_S = 3.0
"""The length assumed for a momentary fault, such as a reset."""
LEVELS = {"alarm": "bad", "warning": "warning", "info": "info"}
"""The levels, worst first, and their CSS classes."""


@dataclass(frozen=True, slots=True)
class FindingGroup:
    """Findings of one code, subject and level, in the order of time."""

    members: tuple[Finding, ...]

    @property
    def level(self) -> str:
        return self.members[0].level

    @property
    def time_s(self) -> float:
        return self.members[0].time_s

    @property
    def worst(self) -> Finding:
        """Return the longest of them, the earliest of equals."""
        return max(self.members, key=lambda each: (each.length_s, -each.time_s))

    @property
    def text(self) -> str:
        """Return one line: the text of a single finding, or the number and the longest."""
        worst, count = self.worst, len(self.members)
        if count == 1:
            return worst.text
        if not worst.length_s:
            return f"{worst.text} ({count} times of this kind)"
        longest = f"the longest for {duration_text(worst.length_s)} at {clock_text(worst.time_s)}"
        return f"{worst.summary} {count} times, {longest}"


def groups_of(findings: Sequence[Finding]) -> list[FindingGroup]:
    """Return the kinds in the order of their first time."""
    found: dict[tuple[str, str, str], list[Finding]] = {}
    for each in findings:
        found.setdefault((each.level, each.code, each.subject), []).append(each)
    return [FindingGroup(tuple(members)) for members in found.values()]


def worst_of(findings: Sequence[Finding]) -> Finding:
    """Return the worst: by level, then by length, then the earliest."""
    return min(
        findings,
        key=lambda each: (
            [*LEVELS].index(each.level),
            -(each.length_s or MOMENTARY_S),
            each.time_s,
        ),
    )


def verdict_of(summary: FlightSummary, findings: Sequence[Finding]) -> tuple[str, str]:
    """Return ``good``, ``warning`` or ``bad``, and the sentences."""
    kinds = [each.worst for each in groups_of(findings)]
    alarms = [each for each in kinds if each.level == "alarm"]
    warnings = [each for each in kinds if each.level == "warning"]
    if alarms:
        worst = worst_of(alarms)
        text = f"The worst, at {clock_text(worst.time_s)}: {worst.text}."
        return "bad", f"{_flight(summary)} {_counted(alarms, warnings)} {text}"
    if warnings:
        return "warning", f"{_flight(summary)} No alarm, {_number(len(warnings), 'warning')}."
    return "good", f"{_flight(summary)} The log shows no fault."


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
    more = f" and {_number(len(warnings), 'warning')}" if warnings else ""
    text = f"{_number(len(alarms), 'alarm')}{more}."
    return f"{text[0].upper()}{text[1:]}"


def _number(count: int, noun: str) -> str:
    words = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
    word = words[count] if count < len(words) else str(count)
    return f"{word} {noun}{'' if count == 1 else 's'}"
