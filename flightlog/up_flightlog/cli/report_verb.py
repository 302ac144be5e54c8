"""``up log report``."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from up.fields import printable
from up.output import echo
from up_flightlog.cli.open_flight import flight_of
from up_flightlog.cli.terminal import DecodingProgress, Progress, warn
from up_flightlog.export.output import file_exists, make_folder, write_file
from up_flightlog.plots.canvas import PictureError
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.flights import Flight
from up_flightlog.report.content import ReportContent, report_content
from up_flightlog.report.finding_groups import verdict_of
from up_flightlog.report.images import ImageSet, image_sets
from up_flightlog.report.page import page_of

PAGE = "report.html"


def run(values: argparse.Namespace) -> int:
    """Write the report of a flight."""
    flight = flight_of(values)
    folder = values.output or default_folder(flight)
    _check_new(folder, may_overwrite=values.force)
    log = FlightLog.read(flight.paths)
    with DecodingProgress("analysing", log):
        content = report_content(log, flight.number)
    files = write_report(content, folder, may_overwrite=values.force)
    _, sentence = verdict_of(content.summary, content.findings)
    echo(printable(sentence))
    echo(str(files[0]))
    if len(files) > 1:
        echo(f"{len(files) - 1} pictures beside it")
    return 0


def default_folder(flight: Flight) -> Path:
    """Return the default place of a report: beside the flight, otherwise the current folder."""
    name = f"{flight.name}-report"
    beside = flight.paths[0].parent
    return beside / name if os.access(beside, os.W_OK) else Path(name)


def write_report(content: ReportContent, folder: Path, *, may_overwrite: bool) -> list[Path]:
    """Write page and pictures; return the files, the page first.

    Without matplotlib the page has text, tables and an SVG track, and a warning is shown.
    Raises CliError for an existing file or a failed write, FlightLogError.
    """
    _check_new(folder, may_overwrite=may_overwrite)
    make_folder(folder)
    images: dict[str, ImageSet] = {}
    missing = ""
    try:
        count = len(content.pictures) + 1
        with Progress("drawing, picture") as progress:
            progress.show(f"1 of {count}")
            for number, image in enumerate(image_sets(content), 2):
                images[image.name] = image
                progress.show(f"{number} of {count}")
    except PictureError as error:
        missing = f"No pictures: {error}."
        warn(missing)
    page = page_of(content, images, missing).encode()
    files = [folder / PAGE]
    write_file(files[0], page, may_overwrite=may_overwrite)
    for image in images.values():
        path = folder / f"{image.name}.png"
        write_file(path, image.wide, may_overwrite=may_overwrite)
        files.append(path)
    return files


def _check_new(folder: Path, *, may_overwrite: bool) -> None:
    if not may_overwrite and (folder / PAGE).exists():
        raise file_exists(folder / PAGE)
