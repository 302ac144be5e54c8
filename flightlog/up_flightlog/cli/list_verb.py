"""``up log list``."""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from up.cli.cli_error import UsageError
from up.fields import printable
from up.output import echo, table
from up_flightlog.cli.open_flight import flights_folder
from up_flightlog.cli.overview import (
    Overview,
    OverviewCache,
    cache_path,
    overview_of,
)
from up_flightlog.cli.terminal import Progress, warn
from up_flightlog.read.flights import Flight, demo_hint, flights_in
from up_flightlog.read.log_files import is_being_recorded
from up_flightlog.read.spans import duration_text
from up_flightlog.report.formatting import is_clock_right, size_text, start_text

HEAD = ("no.", "start", "length", "aircraft", "armed", "highest", "size", "")


@dataclasses.dataclass(frozen=True, slots=True)
class Line:
    """A flight with its line of the list."""

    flight: Flight
    overview: Overview
    is_recording: bool

    @property
    def note(self) -> str:
        if self.is_recording:
            return "being recorded"
        if self.overview.fault is not None:
            return self.overview.fault
        return "" if self.overview.is_complete else "cut off"

    @property
    def has_wrong_clock(self) -> bool:
        return self.overview.fault is None and not is_clock_right(self.overview.start_unix_s)


def run(values: argparse.Namespace) -> int:
    """List the flights, newest last."""
    folder = flights_folder(values)
    if not folder.is_dir() and values.folder is not None:
        raise UsageError(f"{folder} is not a folder", "no_such_folder")
    flights = flights_in(folder) if folder.is_dir() else []
    lines = lines_of(flights, OverviewCache(cache_path(os.environ)))
    if values.json:
        echo(json.dumps(document(folder, lines), indent=2))
    elif lines:
        echo(table(HEAD, map(_cells, lines), right=(0, 2, 4, 5, 6)))
        if any(line.has_wrong_clock for line in lines):
            warn(
                "A Raspberry Pi has no battery-backed clock: without a network its time is wrong."
                " The numbers give the order."
            )
    else:
        echo(f"no flight in {printable(str(folder))}{demo_hint()}")
    return 0


def lines_of(flights: Sequence[Flight], cache: OverviewCache) -> list[Line]:
    """Return a line for every flight, from the cache where possible."""
    lines = []
    with Progress("reading flight") as progress:
        for number, flight in enumerate(flights, 1):
            progress.show(f"{number} of {len(flights)}")
            is_recording = is_being_recorded(flight.paths[-1])
            overview = None if is_recording else cache.get(flight)
            if overview is None:
                overview = overview_of(flight)
                if not is_recording:
                    cache.put(flight, overview)
            lines.append(Line(flight, overview, is_recording))
    cache.save()
    return lines


def document(folder: Path, lines: Sequence[Line]) -> dict[str, Any]:
    """Return the list for programs: times in seconds, sizes in bytes."""
    return {
        "folder": str(folder),
        "flights": [
            {
                "number": line.flight.number,
                "files": [str(path) for path in line.flight.paths],
                "bytes": line.flight.size,
                **dataclasses.asdict(line.overview),
                "is_clock_right": is_clock_right(line.overview.start_unix_s),
                "is_recording": line.is_recording,
            }
            for line in lines
        ],
    }


def _cells(line: Line) -> tuple[str, ...]:
    flight, overview = line.flight, line.overview
    is_known = overview.fault is None
    highest = "-" if overview.highest_m is None else f"{overview.highest_m:.0f} m"
    return (
        str(flight.number),
        start_text(overview.start_unix_s) if is_known else "-",
        duration_text(overview.length_s) if is_known else "-",
        overview.aircraft,
        duration_text(overview.armed_s) if overview.armed_s else "-",
        highest,
        size_text(flight.size),
        line.note,
    )
