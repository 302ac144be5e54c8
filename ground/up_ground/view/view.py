"""The verb ``view``: makes the columns of flights on the first look, and serves them."""

from __future__ import annotations

import argparse
import hashlib
import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from up.cli.cli_error import CliError
from up.fields import printable
from up.flight_log.mcap_format import FlightLogError
from up_flightlog.cli.open_flight import flight_named
from up_flightlog.cli.overview import cache_path, state_of
from up_flightlog.cli.terminal import DecodingProgress
from up_flightlog.columns.build import FORMAT, build_columns
from up_flightlog.columns.column_file import ColumnFile
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.flights import Flight
from up_ground.one_shot_task import print_error
from up_ground.one_shot_task import run as run_task
from up_ground.view.log_resource import ShownFlight

MAX_KEPT = 20
"""Files of columns in the cache; the one that was looked at least recently goes first."""


def run(options: argparse.Namespace) -> int:
    """Serve the page; returns the exit status. Raises UsageError, FlightLogError, CliError."""
    from up_ground.view.log_server import LogServer

    names = [options.flight, *([options.other] if options.other else [])]
    flights = [flight_named(name, options) for name in names]
    shown = [ShownFlight(each.name, columns_of(each, os.environ)) for each in flights]
    return run_task(lambda reactor: LogServer(reactor, options.port, shown))


def columns_of(flight: Flight, environ: Mapping[str, str]) -> ColumnFile:
    """Return the columns of a flight from the cache, made if its files changed."""
    state: Any = [FORMAT, state_of(flight)]
    key = hashlib.sha256(os.fsencode(flight.paths[0].absolute())).hexdigest()[:32]
    folder = cache_path(environ).with_name("columns")
    path = folder / f"{key}.columns"
    with suppress(FlightLogError):
        found = ColumnFile(path)
        if found.about.get("state") == state:
            path.touch()
            return found
    _build(flight, path, state)
    return ColumnFile(path)


def _build(flight: Flight, path: Path, state: Any) -> None:
    log = FlightLog.read(flight.paths)
    for problem in log.problems[:5]:
        print_error(printable(problem.text), "log_damaged")
    if not log.topics:
        raise FlightLogError(f"{flight.paths[0].name} holds no message", "empty_flight")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with suppress(OSError):
            kept = sorted(path.parent.glob("*.columns"), key=lambda each: each.stat().st_mtime)
            for each in kept[: -MAX_KEPT + 1]:
                each.unlink()
    except OSError as error:
        raise CliError(f"cannot create {path.parent}: {error.strerror or error}") from error
    with DecodingProgress("first look", log):
        build_columns(log, path, state)
