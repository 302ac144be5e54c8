"""Faults grouped by kind, however many there are."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from black_box_cog.report.wording import clock_text
from up.flight_log.spans import duration_text
from up.flight_log.summary import Wrong

WITHOUT_LENGTH_S = 3.0
"""The length assumed for a momentary fault, such as a reset."""
_LEVELS = ("alarm", "warning", "info")
_DURATION = r"(?:\d+ h \d+ min|\d+ min \d+ s|[\d.]+ s)"
_FOR = re.compile(rf" for {_DURATION}(?: until the end)?")
_NUMBER = re.compile(r"\d+(?:\.\d+)?")


@dataclass(frozen=True, slots=True)
class WrongGroup:
    """Faults of one kind and level, in the order of time."""

    members: tuple[Wrong, ...]

    @property
    def level(self) -> str:
        """Return the level of the kind."""
        return self.members[0].level

    @property
    def time_s(self) -> float:
        """Return the first time."""
        return self.members[0].time_s

    @property
    def worst(self) -> Wrong:
        """Return the longest of them, the earliest of equals."""
        return max(self.members, key=lambda each: (each.length_s, -each.time_s))

    @property
    def text(self) -> str:
        """Return one line: the text of a single fault, or the number and the longest."""
        worst, count = self.worst, len(self.members)
        if count == 1:
            return worst.text
        if not worst.length_s:
            return f"{worst.text} ({count} times of this kind)"
        longest = f"the longest for {duration_text(worst.length_s)} at {clock_text(worst.time_s)}"
        return f"{_FOR.split(worst.text)[0]} {count} times, {longest}"


def groups_of(wrongs: Sequence[Wrong]) -> list[WrongGroup]:
    """Return the kinds in the order of their first time."""
    found: dict[tuple[str, str], list[Wrong]] = {}
    for each in wrongs:
        found.setdefault((each.level, _kind(each)), []).append(each)
    return [WrongGroup(tuple(members)) for members in found.values()]


def worst_of(wrongs: Sequence[Wrong]) -> Wrong:
    """Return the worst: by level, then by length, then the earliest."""
    return min(
        wrongs,
        key=lambda each: (
            _LEVELS.index(each.level),
            -(each.length_s or WITHOUT_LENGTH_S),
            each.time_s,
        ),
    )


def _kind(wrong: Wrong) -> str:
    return _FOR.split(wrong.text)[0] if wrong.length_s else _NUMBER.sub("#", wrong.text)
