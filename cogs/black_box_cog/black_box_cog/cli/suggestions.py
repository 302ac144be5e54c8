"""Suggestions for a topic or a field that a log does not have."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from up.cli.cli_error import CliError
from up.fields import printable
from up.flight_log.flight_log import FlightLog

MAX_LISTED = 10


def no_such_topic(topic: str, log: FlightLog) -> CliError:
    """Return the sentence for a topic that the log does not have."""
    return _no_such("topic", topic, log.topics, "'up log info' lists all")


def no_such_field(field: str, known: Iterable[str]) -> CliError:
    """Return the sentence for a field that no topic has."""
    return _no_such("field with numbers", field, known, "'up log export' writes all of a topic")


def _no_such(what: str, named: str, known: Iterable[str], how: str) -> CliError:
    names = sorted(known)
    sentence = f"no {what} is called '{printable(named)}'"
    near = difflib.get_close_matches(named[:100], names, n=1, cutoff=0.5)
    if near:
        return CliError(f"{sentence}, did you mean {printable(near[0])}?")
    if not names:
        return CliError(f"{sentence}: the log has none")
    likely = difflib.get_close_matches(named[:100], names, n=MAX_LISTED, cutoff=0.0)
    listed = ", ".join(map(printable, sorted(likely)))
    more = f" and {len(names) - len(likely)} more ({how})" if len(names) > len(likely) else ""
    return CliError(f"{sentence}; there are {listed}{more}")
