"""A fault that was found in a flight."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Literal

from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.read.spans import Span

Level = Literal["info", "warning", "alarm"]


@dataclass(frozen=True, slots=True)
class Finding:
    """``code``, ``subject`` and ``fields`` are for programs, the text is for people.

    ``time_s`` counts from the log's first message. Findings of one code and one ``subject`` (a
    reading, an axis, a Command) are of one kind. ``span`` is None for a momentary fault.
    """

    time_s: float
    level: Level
    code: str
    summary: str
    detail: str = ""
    span: Span | None = None
    subject: str = ""
    fields: Mapping[str, Any] = field(default_factory=dict)

    @property
    def length_s(self) -> float:
        return 0.0 if self.span is None else self.span.length_s

    @property
    def text(self) -> str:
        """Return one line: the summary, the duration and the details."""
        length = "" if self.span is None else f" {self.span.length_text}"
        return f"{self.summary}{length}{self.detail}"


Check = Callable[[FlightContext], Iterator[Finding]]
"""Searches a flight for one kind of fault; a new kind is a function and an entry in a table."""


def lasting(
    span: Span,
    level: Level,
    code: str,
    summary: str,
    detail: str = "",
    subject: str = "",
    fields: Mapping[str, Any] = MappingProxyType({}),
) -> Finding:
    """Return a finding about the whole of a span."""
    return Finding(span.begin_s, level, code, summary, detail, span, subject, fields)
