"""Findings grouped by kind, however many there are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from black_box_cog.report.formatting import clock_text
from up.flight_log.finding import Finding
from up.flight_log.spans import duration_text

MOMENTARY_S = 3.0
"""The length assumed for a momentary fault, such as a reset."""
_LEVELS = ("alarm", "warning", "info")


@dataclass(frozen=True, slots=True)
class FindingGroup:
    """Findings of one code, subject and level, in the order of time."""

    members: tuple[Finding, ...]

    @property
    def level(self) -> str:
        """Return the level of the kind."""
        return self.members[0].level

    @property
    def time_s(self) -> float:
        """Return the first time."""
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
            _LEVELS.index(each.level),
            -(each.length_s or MOMENTARY_S),
            each.time_s,
        ),
    )
