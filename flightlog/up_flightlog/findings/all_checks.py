"""The faults of a flight in the order of time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from up.fields import printable
from up_flightlog.findings.board_checks import BOARD_CHECKS
from up_flightlog.findings.finding import Check, Finding
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.findings.link_checks import LINK_CHECKS
from up_flightlog.findings.program_checks import PROGRAM_CHECKS
from up_flightlog.read.flight_log import FlightLog

ALL_CHECKS: tuple[Check, ...] = (*BOARD_CHECKS, *LINK_CHECKS, *PROGRAM_CHECKS)
_MAX_PER_CHECK = 50
_MAX_TEXT = 500


def findings(log: FlightLog, context: FlightContext | None = None) -> list[Finding]:
    """Return the faults; texts are one line, safe for a terminal.

    ``context`` reuses the data that another summary of the same log has read.
    """
    context = context or FlightContext(log)
    found = [each for check in ALL_CHECKS for each in _bounded(check(context))]
    return sorted(found, key=lambda each: each.time_s)


def _bounded(found: Iterable[Finding]) -> Iterator[Finding]:
    """Yield the first findings of a check; the last one counts the rest."""
    more: Finding | None = None
    count = 0
    for count, each in enumerate(found, 1):
        if count <= _MAX_PER_CHECK:
            yield _one_line(each)
        elif more is None:
            more = _one_line(each)
    if more is not None:
        rest = count - _MAX_PER_CHECK - 1
        detail = f"{more.detail} (and {rest} more of this kind)"
        yield replace(more, detail=detail, fields={**more.fields, "more": rest})


def _one_line(finding: Finding) -> Finding:
    return replace(finding, summary=_line(finding.summary), detail=_line(finding.detail))


def _line(text: str) -> str:
    return printable(text if len(text) <= _MAX_TEXT else text[:_MAX_TEXT] + "...")
