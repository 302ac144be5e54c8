"""The verb ``replay``."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import Any

from up.fields import printable
from up.flight_log.flights_folder import folder_of
from up.flight_log.mcap_format import FlightLogError
from up.output import echo
from up.sanitize_text import sanitize_text
from up_flightlog.cli.parser import PLACE
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.flights import find_flight_of
from up_ground.one_shot_task import print_error
from up_ground.one_shot_task import run as run_task
from up_ground.replay.replayed_aircraft import ReplayedAircraft
from up_ground.replay.timeline import ReplayTimeline
from up_ground.web.serve import PageOptions


def run(options: argparse.Namespace) -> int:
    """Serve the page with a flight; returns the exit status. Raises UsageError, FlightLogError."""
    page = PageOptions.of(options, os.environ)
    paths = find_flight_of(options.flight, lambda: _folder(options)).paths
    echo(f"reading {printable(', '.join(path.name for path in paths))} ...")
    log = FlightLog.read(paths)
    timeline = ReplayTimeline(log, aircraft_of(log))
    if not log.topics:
        raise FlightLogError(f"{paths[0].name} holds no message", "empty_flight")
    for problem in log.problems[:5]:
        print_error(printable(problem.text), "log_damaged")
    title = sanitize_text(paths[0].name.removesuffix(".mcap"), 100)

    def make(reactor: Any) -> Any:
        return page.server(
            reactor,
            lambda subscribers: [ReplayedAircraft(reactor, log, timeline, title, subscribers)],
            is_replay=True,
        )

    return run_task(make)


def _folder(options: argparse.Namespace) -> Path:
    """Return where flights are looked up: as ``up log`` knows it, where that was asked."""
    place = getattr(options, PLACE, None)
    return place(options) if place is not None else folder_of(options.folder or "")


def aircraft_of(log: FlightLog) -> str:
    """Return the aircraft's name from the log."""
    name = log.metadata.get("flight", {}).get("aircraft", "")
    return sanitize_text(name, 32) or "flight"
