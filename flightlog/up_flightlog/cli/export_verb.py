"""``up log export``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryFile

from up.cli.cli_error import CliError
from up.output import echo
from up_flightlog.cli.open_flight import check_topics, flight_of, unknown_topic
from up_flightlog.cli.terminal import DecodingProgress, warn
from up_flightlog.export.csv_table import topic_lines, wide_lines
from up_flightlog.export.gpx import gpx_lines
from up_flightlog.export.kml import kml_lines
from up_flightlog.export.output import make_folder, new_file
from up_flightlog.export.track import track_of
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.flights import Flight
from up_flightlog.read.spans import duration_text
from up_flightlog.report.formatting import is_clock_right, start_text

RATE_HZ = 10.0
MAX_ROWS = 10_000_000
STDOUT = Path("-")
_NOT_IN_A_TABLE = ("log", "/location")
"""Texts, which have no rate, and Foxglove's copy of the position."""


def run(values: argparse.Namespace) -> int:
    """Convert a flight to another format."""
    if values.format != "csv" and (values.topic or values.rate):
        raise CliError(f"--topic and --rate apply to csv, not to {values.format}", status=2)
    flight = flight_of(values)
    check_topics(flight, values.topic)
    log = FlightLog.read(flight.paths)
    with DecodingProgress("exporting", log):
        if values.format == "csv":
            _export_csv(log, flight, values)
        else:
            _export_track(log, flight, values)
    return 0


def _export_track(log: FlightLog, flight: Flight, values: argparse.Namespace) -> None:
    track = track_of(log, *_names(log, flight))
    if not track.segments:
        raise CliError(f"{flight.paths[0].name} has no positions")
    if not is_clock_right(log.start_unix_s):
        warn("the clock was wrong during the recording, so the times in the file are wrong")
    lines = gpx_lines if values.format == "gpx" else kml_lines
    _write(lines(track), values.output or Path(f"{flight.name}.{values.format}"), values.force)


def _export_csv(log: FlightLog, flight: Flight, values: argparse.Namespace) -> None:
    for topic in values.topic:
        if topic not in log.topics:
            raise unknown_topic(topic, log.topics)
    topics = list(dict.fromkeys(values.topic))
    if values.rate or not topics:
        topics = topics or [topic for topic in log.topics if topic not in _NOT_IN_A_TABLE]
        path = values.output or Path(f"{flight.name}.csv")
        _write(_wide(log, topics, values.rate or RATE_HZ), path, values.force)
    elif len(topics) == 1:
        path = values.output or Path(f"{flight.name}.{_file_name(topics[0])}")
        _write(_one(log, topics[0]), path, values.force)
    else:
        folder = values.output or Path(flight.name)
        if folder == STDOUT:
            raise CliError("several topics need a folder: name it with -o", status=2)
        make_folder(folder)
        for topic in topics:
            _write(_one(log, topic), folder / _file_name(topic), values.force)


def _one(log: FlightLog, topic: str) -> Iterator[str]:
    with TemporaryFile("w+", encoding="utf-8", newline="\n") as spool:
        yield from topic_lines(log.messages(topic), log.start_unix_s, spool)


def _wide(log: FlightLog, topics: Sequence[str], rate_hz: float) -> Iterator[str]:
    if not topics:
        raise CliError("the log has no messages")
    if log.length_s * rate_hz > MAX_ROWS:
        raise CliError(
            f"a table of {log.length_s * rate_hz:.0f} rows is too long: use a lower --rate"
        )
    # A message that a newer one replaces before the next row is not decoded.
    messages = log.messages(*topics, rate_hz=rate_hz)
    with TemporaryFile("w+", encoding="utf-8", newline="\n") as spool:
        yield from wide_lines(messages, log.start_unix_s, log.length_s, rate_hz, spool)


def _write(texts: Iterable[str], path: Path, may_overwrite: bool) -> None:
    if path == STDOUT:
        sys.stdout.writelines(texts)
        return
    if not path.parent.is_dir():
        raise CliError(f"no folder {path.parent}: nothing is written")
    count = 0
    with new_file(path, may_overwrite=may_overwrite) as file:
        for text in texts:
            count += file.write(text.encode())
    echo(f"{path}  {count / 1000:.0f} kB")


def _names(log: FlightLog, flight: Flight) -> tuple[str, str]:
    aircraft = log.metadata.get("flight", {}).get("aircraft", flight.aircraft)
    number = "" if flight.number is None else f" {flight.number}"
    begun = start_text(log.start_unix_s)
    return f"{aircraft} flight{number}", f"{aircraft}, {begun}, {duration_text(log.length_s)}"


def _file_name(topic: str) -> str:
    """Return a topic as a file name without folders or special characters."""
    plain = "".join(c if c.isascii() and (c.isalnum() or c in "._-") else "_" for c in topic)
    return f"{plain.strip('._')[:100] or 'topic'}.csv"
