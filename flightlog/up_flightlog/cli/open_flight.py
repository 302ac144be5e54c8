"""Opens the log of the flight that a verb names, and finds its topics and fields."""

from __future__ import annotations

import argparse
import difflib
import os
import sys
from collections.abc import Iterable
from importlib.metadata import entry_points
from pathlib import Path

from up.cli.cli_error import UsageError
from up.cli.locate import application_of
from up.fields import printable
from up.flight_log.flights_folder import default_folder, folder_of
from up.loading.application import NoApplicationError
from up_flightlog.read.flights import Flight, find_flight
from up_flightlog.read.log_summary import summary_topics

FOLDER_FILES = "up.flights_folder"
"""The group of entry points by which a recorder names its configuration file, with ``folder``."""
MAX_LISTED = 10
_LARGE = 5_000_000


def flights_folder(values: argparse.Namespace) -> Path:
    """Return ``--folder``, otherwise the folder in black_box.yml, otherwise the default one.

    Outside of an application, and without ``--config``, there is no black_box.yml. Raises
    ConfigErrors, and UsageError for a ``--file`` that does not exist.
    """
    if values.folder is not None:
        return Path(values.folder)
    config: Path | None = values.config
    if config is None:
        try:
            config = application_of(values).config_folder
        except NoApplicationError:
            return default_folder(os.environ)
    for recorder in entry_points(group=FOLDER_FILES):
        return folder_of(recorder.load().load(config).folder, os.environ)
    return default_folder(os.environ)


def flight_of(values: argparse.Namespace) -> Flight:
    """Return the flight that FLIGHT names; raises FlightLogError and ConfigErrors."""
    return flight_named(values.flight, values)


def flight_named(name: str, values: argparse.Namespace) -> Flight:
    """Return the flight that a name selects, as `flight_of`."""
    # Only a name that is not a path needs the folder, and so a valid configuration.
    flight = find_flight(name, lambda: flights_folder(values))
    if sys.stderr.isatty() and flight.size > _LARGE:
        sys.stderr.write(f"reading {len(flight.paths)} files, {flight.size / 1e6:.0f} MB ...\n")
    return flight


def check_topics(flight: Flight, named: Iterable[str]) -> None:
    """Reject unknown topics by the summary of the files, before they are read.

    A name may go on with a field. Raises UsageError; a log without a summary passes.
    """
    topics = summary_topics(flight.paths)
    for name in named if topics is not None else ():
        if not any(f"{name}.".startswith(f"{topic}.") for topic in topics or ()):
            raise unknown_topic(name, topics or ())


def unknown_topic(topic: str, known: Iterable[str]) -> UsageError:
    """Return the error for a topic that the log does not have."""
    return _unknown("topic", topic, known, "'up log info' lists all")


def unknown_field(field: str, known: Iterable[str]) -> UsageError:
    """Return the error for a field that no topic has."""
    return _unknown("numeric field", field, known, "'up log export' writes all of a topic")


def _unknown(kind: str, name: str, known: Iterable[str], hint: str) -> UsageError:
    names, code = sorted(known), f"no_such_{kind.split()[-1]}"
    text = f"no {kind} is called '{printable(name)}'"
    near = difflib.get_close_matches(name[:100], names, n=1, cutoff=0.5)
    if near:
        return UsageError(f"{text}, did you mean {printable(near[0])}?", code)
    if not names:
        return UsageError(f"{text}: the log has none", code)
    likely = difflib.get_close_matches(name[:100], names, n=MAX_LISTED, cutoff=0.0)
    listed = ", ".join(map(printable, sorted(likely)))
    more = f" and {len(names) - len(likely)} more ({hint})" if len(names) > len(likely) else ""
    return UsageError(f"{text}; the log has {listed}{more}", code)
