"""``up log report``."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from black_box_cog.cli.open_flight import flight_of, read
from black_box_cog.cli.terminal import tell, warn
from black_box_cog.report.content import report_content
from black_box_cog.report.folder import write_report
from black_box_cog.report.verdict import verdict_of
from up.cli.cli_error import CliError
from up.fields import printable
from up.flight_log.flights import Flight
from up.flight_log.mcap_format import FlightLogError


def run(values: argparse.Namespace) -> int:
    """Write the report of a flight."""
    flight = flight_of(values)
    log = read(flight)
    folder = values.output or default_folder(flight)
    try:
        content = report_content(log, flight.name, flight.number)
        files = write_report(content, folder, may_overwrite=values.force, on_missing=warn)
    except FlightLogError as error:
        raise CliError(printable(str(error))) from error
    _, sentence = verdict_of(content.summary, content.findings)
    tell(printable(sentence))
    tell(str(files[0]))
    if len(files) > 1:
        tell(f"{len(files) - 1} pictures beside it")
    return 0


def default_folder(flight: Flight) -> Path:
    """Return the default place of a report: beside the flight, otherwise the current folder."""
    name = f"{flight.name}-report"
    beside = flight.paths[0].parent
    return beside / name if os.access(beside, os.W_OK) else Path(name)
