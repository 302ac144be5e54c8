"""The faults of a flight, in plain words and in the order of time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from up.fields import printable
from up.flight_log.board_judgments import BOARD_JUDGMENTS
from up.flight_log.command_judgments import COMMAND_JUDGMENTS
from up.flight_log.facts import Facts
from up.flight_log.flight_log import FlightLog
from up.flight_log.link_judgments import LINK_JUDGMENTS
from up.flight_log.program_judgments import PROGRAM_JUDGMENTS
from up.flight_log.wrong import Judge, Wrong

JUDGMENTS: tuple[Judge, ...] = (
    *BOARD_JUDGMENTS,
    *LINK_JUDGMENTS,
    *COMMAND_JUDGMENTS,
    *PROGRAM_JUDGMENTS,
)
_MOST_OF_A_KIND = 50
_LONGEST_TEXT = 500


def wrongs(log: FlightLog, facts: Facts | None = None) -> list[Wrong]:
    """Return the faults; texts are one line, safe for a terminal.

    ``facts`` reuses the data that another summary of the same log has read.
    """
    facts = facts or Facts(log)
    found = [wrong for judge in JUDGMENTS for wrong in _bounded(judge(facts))]
    return sorted(found, key=lambda each: each.time_s)


def _bounded(found: Iterable[Wrong]) -> Iterator[Wrong]:
    """Yield the first faults of a kind, and the number of the rest."""
    more: Wrong | None = None
    count = 0
    for count, each in enumerate(found, 1):
        if count <= _MOST_OF_A_KIND:
            yield replace(each, text=_line(each.text))
        elif more is None:
            more = each
    if more is not None:
        text = f"{_line(more.text)} (and {count - _MOST_OF_A_KIND - 1} more of this kind)"
        yield replace(more, text=text)


def _line(text: str) -> str:
    return printable(text if len(text) <= _LONGEST_TEXT else text[:_LONGEST_TEXT] + "...")
