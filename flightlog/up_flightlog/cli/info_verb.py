"""``up log info``."""

from __future__ import annotations

import argparse
import dataclasses
import json
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from up.fields import printable
from up.output import echo, table
from up_flightlog.cli.open_flight import flight_of
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.findings.summary import Finding, FlightSummary, findings, summarise
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.flights import Flight
from up_flightlog.read.spans import duration_text
from up_flightlog.report.figures import TOPIC_HEAD, figures_of, gap_rows, topic_rows
from up_flightlog.report.finding_groups import groups_of
from up_flightlog.report.formatting import clock_text, size_text, start_text


def run(values: argparse.Namespace) -> int:
    """Print the summary of a flight."""
    flight = flight_of(values)
    log = FlightLog.read(flight.paths)
    context = FlightContext(log)
    summary, found = summarise(log, context), findings(log, context)
    if values.json:
        echo(json.dumps(document(flight, summary, found), indent=2, default=str))
        return 0
    echo(_title(flight, log, summary))
    _section("faults", _findings(found))
    _section("flight", _pairs(_figures(summary)))
    modes = [
        (clock_text(each.begin_s), each.mode, duration_text(each.end_s - each.begin_s))
        for each in summary.modes
    ]
    _section("modes", _table(("from", "mode", "for"), modes, (0, 2)))
    _section(
        "longest gap of each source", _table(("source", "silent for"), gap_rows(summary), (1,))
    )
    _section("topics", _table(TOPIC_HEAD, topic_rows(log), (1, 2)))
    _section("configuration", sorted(log.attachments))
    _section("versions", _pairs(log.metadata.get("versions", {}).items()))
    _section("files", [str(path) for path in flight.paths])
    _section("file problems", [each.text for each in log.problems])
    return 0


def document(flight: Flight, summary: FlightSummary, found: Sequence[Finding]) -> dict[str, Any]:
    """Return the answer for programs: times in seconds of the log, codes of the findings."""
    names = ("time_s", "level", "code", "subject", "length_s", "text")
    return {
        "number": flight.number,
        "files": [str(path) for path in flight.paths],
        **dataclasses.asdict(summary),
        "findings": [
            {**{name: getattr(each, name) for name in names}, "fields": dict(each.fields)}
            for each in found
        ],
    }


def _section(title: str, lines: Sequence[str]) -> None:
    if lines:
        echo(f"\n{title}")
        for line in lines:
            for row in line.split("\n"):
                echo(f"  {printable(row)}")


def _title(flight: Flight, log: FlightLog, summary: FlightSummary) -> str:
    number = "" if flight.number is None else f"flight {flight.number}, "
    cut = "" if summary.is_complete else ", being recorded" if log.is_recording else ", cut off"
    text = (
        f"{number}{summary.aircraft or flight.aircraft or 'unnamed aircraft'},"
        f" {start_text(log.start_unix_s)}, {duration_text(summary.length_s)},"
        f" {size_text(flight.size)}{cut}"
    )
    return printable(text[0].upper() + text[1:])


def _findings(found: Sequence[Finding]) -> list[str]:
    if not found:
        return ["none in the log"]
    kinds = groups_of(found)
    return [f"{clock_text(each.time_s):>8}  {each.level:<8} {each.text}" for each in kinds]


def _figures(summary: FlightSummary) -> Iterator[tuple[str, str]]:
    yield from figures_of(summary)
    for error in summary.estimate_errors:
        worst = f"{error.worst_deg:.1f} at worst, at {clock_text(error.worst_s)}"
        yield f"error in {error.axis}", f"{error.rms_deg:.1f} deg rms, {worst}"
    if summary.failsafes:
        spans = (f"{clock_text(each.begin_s)} {each.length_text}" for each in summary.failsafes)
        yield "failsafe", ", ".join(spans)
    for mark in summary.marks:
        yield "mark", f"{clock_text(mark.time_s)} {mark.text}"
    for veto in summary.vetoes:
        yield "arming veto", veto
    if summary.warnings or summary.errors:
        yield "log", f"{summary.warnings} warnings, {summary.errors} errors"
    mode = ", ".join(filter(None, (summary.mode, summary.flight_controller)))
    if mode:
        yield "mode, flight controller", mode
    if summary.version:
        yield "version", summary.version


def _table(head: Sequence[str], rows: Sequence[Sequence[str]], right: Sequence[int]) -> list[str]:
    return [table(head, rows, right)] if rows else []


def _pairs(pairs: Iterable[tuple[str, str]]) -> list[str]:
    rows = [(printable(key), printable(value)) for key, value in pairs]
    width = max((len(key) for key, _ in rows), default=0)
    return [f"{key:<{width}}  {value}" for key, value in rows]
