"""What a user meant who named a topic or a field that a log does not have."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from up.cli.cli_error import CliError
from up.fields import printable
from up.flight_log.flight_log import FlightLog

MOST_LISTED = 40


def no_such_topic(topic: str, log: FlightLog) -> CliError:
    """Return the sentence for a topic that the log does not have."""
    return _no_such("topic", topic, log.topics)


def no_such_field(field: str, known: Iterable[str]) -> CliError:
    """Return the sentence for a field that no topic has."""
    return _no_such("field with numbers", field, known)


def _no_such(what: str, named: str, known: Iterable[str]) -> CliError:
    names = sorted(known)
    near = difflib.get_close_matches(named[:100], names, n=1, cutoff=0.5)
    if near:
        return CliError(
            f"the log has no {what} {printable(named)}, did you mean {printable(near[0])}?"
        )
    listed = ", ".join(map(printable, names[:MOST_LISTED]))
    more = f" and {len(names) - MOST_LISTED} more" if len(names) > MOST_LISTED else ""
    return CliError(f"the log has no {what} {printable(named)}; it has {listed or 'none'}{more}")
