"""Spans of a flight in which a condition held."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Span:
    """Start and end, s; ``is_open``: the condition still held at the end of the log."""

    begin_s: float
    end_s: float
    is_open: bool = False

    @property
    def length_s(self) -> float:
        return self.end_s - self.begin_s

    @property
    def length_text(self) -> str:
        """Return the length in words: for 1.2 s, for 2 min 05 s."""
        return f"for {duration_text(self.length_s)}" + (" until the end" if self.is_open else "")


def spans_of(states: Iterable[tuple[float, bool]], end_s: float) -> list[Span]:
    """Return where a state (time in s, whether it held) was true; ``end_s`` is the log's end."""
    found: list[Span] = []
    begin_s: float | None = None
    for time_s, holds in states:
        if holds and begin_s is None:
            begin_s = time_s
        elif not holds and begin_s is not None:
            found.append(Span(begin_s, time_s))
            begin_s = None
    if begin_s is not None:
        found.append(Span(begin_s, max(begin_s, end_s), is_open=True))
    return found


def joined(spans: Sequence[Span], apart_s: float) -> list[Span]:
    """Return the spans, merging those that are at most this far apart."""
    found: list[Span] = []
    for span in spans:
        if found and span.begin_s - found[-1].end_s <= apart_s:
            span = Span(found.pop().begin_s, span.end_s, span.is_open)
        found.append(span)
    return found


def duration_text(seconds: float) -> str:
    """Return 0.35 s, 1.2 s, 48 s, 2 min 05 s or 1 h 02 min."""
    if seconds < 0.995:
        return f"{seconds:.2f} s"
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"
