"""Columns of a log as numbers for drawing, thinned so that a long flight stays drawable."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

MAX_POINTS = 6000


class Log(Protocol):
    """The part of a flight's log that pictures and analyses use (``scenario.log.FlightLog``)."""

    def __contains__(self, column: object) -> bool:
        """Return whether there is a column of that name."""

    def numbers(self, name: str) -> list[float]:
        """Return a column of numbers; not a number where the value is not known."""

    def column(self, name: str) -> Sequence[float | str]:
        """Return a column."""

    @property
    def events(self) -> list[tuple[float, str]]:
        """Return time and name of the events."""


@dataclass(frozen=True, slots=True)
class Span:
    """A part of the flight with a name."""

    begin_s: float
    end_s: float
    name: str


def numbers(log: Log, name: str) -> list[float] | None:
    """Return a column, or ``None`` if it is missing or entirely unknown."""
    if name not in log:
        return None
    values = log.numbers(name)
    return values if any(math.isfinite(value) for value in values) else None


def thinned(
    times_s: Sequence[float], values: Sequence[float], most: int = MAX_POINTS
) -> tuple[list[float], list[float]]:
    """Return at most about ``most`` points that keep every peak and every gap."""
    if len(values) <= most:
        return list(times_s), list(values)
    width = math.ceil(2 * len(values) / most)
    kept_s: list[float] = []
    kept: list[float] = []
    for first in range(0, len(values), width):
        bucket = range(first, min(first + width, len(values)))
        known = [at for at in bucket if math.isfinite(values[at])]
        chosen = {bucket[0]}
        if known:
            chosen = {min(known, key=values.__getitem__), max(known, key=values.__getitem__)}
            chosen |= {at for at in (bucket[0], bucket[-1]) if not math.isfinite(values[at])}
        for at in sorted(chosen):
            kept_s.append(times_s[at])
            kept.append(values[at])
    return kept_s, kept


def mode_spans(log: Log) -> list[Span]:
    """Return which mode flew when; a lost receiver's circle is FAILSAFE."""
    if "board.mode" not in log:
        return []
    modes = [str(mode) for mode in log.column("board.mode")]
    if "board.failsafe" in log:
        flags = log.numbers("board.failsafe")
        modes = ["FAILSAFE" if flag == 1 else mode for mode, flag in zip(modes, flags, strict=True)]
    return list(_runs(log.numbers("time_s"), modes))


def track(log: Log) -> tuple[list[float], list[float]] | None:
    """Return metres east and north of the start; ``None`` if the log lacks them."""
    north, east = numbers(log, "truth.north_m"), numbers(log, "truth.east_m")
    return None if north is None or east is None else (east, north)


def crash_index(log: Log) -> int | None:
    """Return the row at which it crashed."""
    flags = numbers(log, "truth.crashed")
    return None if flags is None or 1.0 not in flags else flags.index(1.0)


def _runs(times_s: Sequence[float], names: Sequence[str]) -> Iterator[Span]:
    begin = 0
    for at in range(1, len(names) + 1):
        if at == len(names) or names[at] != names[begin]:
            if names[begin]:
                yield Span(times_s[begin], times_s[min(at, len(names) - 1)], names[begin])
            begin = at
