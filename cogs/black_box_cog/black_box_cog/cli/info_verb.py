"""``up log info``."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator, Sequence

from black_box_cog.cli.open_flight import flight_of, read
from black_box_cog.cli.terminal import table, tell
from black_box_cog.report.finding_groups import groups_of
from black_box_cog.report.formatting import clock_text, size_text, start_text
from up.cli.cli_error import CliError
from up.fields import printable
from up.flight_log.flight_context import FlightContext
from up.flight_log.flight_log import FlightLog
from up.flight_log.flights import Flight
from up.flight_log.mcap_format import FlightLogError
from up.flight_log.spans import duration_text
from up.flight_log.summary import Finding, FlightSummary, findings, summarise


def run(values: argparse.Namespace) -> int:
    """Print the summary of a flight."""
    flight = flight_of(values)
    log = read(flight)
    try:
        context = FlightContext(log)
        summary, wrong = summarise(log, context), findings(log, context)
    except FlightLogError as error:
        raise CliError(printable(str(error))) from error
    tell(_title(flight, log, summary))
    _section("what went wrong", _wrongs(wrong))
    _section("flight", _pairs(_figures(summary)))
    _section("modes", _modes(summary))
    _section("longest gap of each source", _gaps(summary))
    _section("topics", _topics(log))
    _section("configuration", sorted(log.attachments))
    _section("versions", _pairs(log.metadata.get("versions", {}).items()))
    _section("files", [str(path) for path in flight.paths])
    _section("problems of the files", [each.text for each in log.problems])
    return 0


def _section(title: str, lines: Sequence[str]) -> None:
    if lines:
        tell(f"\n{title}")
        for line in lines:
            for row in line.split("\n"):
                tell(f"  {printable(row)}")


def _title(flight: Flight, log: FlightLog, summary: FlightSummary) -> str:
    number = "" if flight.number is None else f"flight {flight.number}, "
    cut = "" if summary.is_complete else ", cut off"
    text = (
        f"{number}{summary.aircraft or flight.aircraft or 'an aircraft without a name'},"
        f" {start_text(log.start_unix_s)}, {duration_text(summary.length_s)},"
        f" {size_text(flight.size)}{cut}"
    )
    return printable(text[0].upper() + text[1:])


def _wrongs(found: Sequence[Finding]) -> list[str]:
    if not found:
        return ["nothing that the log can tell"]
    kinds = groups_of(found)
    return [f"{clock_text(each.time_s):>8}  {each.level:<8} {each.text}" for each in kinds]


def _figures(summary: FlightSummary) -> Iterator[tuple[str, str]]:
    yield "armed", duration_text(summary.armed_s) if summary.armed else "never"
    if summary.highest_m is not None and summary.lowest_m is not None:
        yield "altitude", f"{summary.lowest_m:.0f} to {summary.highest_m:.0f} m"
    for name, value, unit in (
        ("top speed", summary.top_speed_m_s, "m/s"),
        ("track", summary.track_m, "m"),
        ("farthest from home", summary.farthest_m, "m"),
        ("lowest battery", summary.lowest_battery_percent, "percent"),
    ):
        if value is not None:
            yield name, f"{value:.{1 if unit == 'm/s' else 0}f} {unit}"
    for error in summary.estimate_errors:
        worst = f"{error.worst_deg:.1f} at worst, at {clock_text(error.worst_s)}"
        yield f"error in {error.axis}", f"{error.rms_deg:.1f} deg rms, {worst}"
    if summary.failsafes:
        yield (
            "failsafe",
            ", ".join(
                f"{clock_text(each.begin_s)} {each.length_text}" for each in summary.failsafes
            ),
        )
    for mark in summary.marks:
        yield "mark", f"{clock_text(mark.time_s)} {mark.text}"
    for veto in summary.vetoes:
        yield "arming vetoed", veto
    if summary.warnings or summary.errors:
        yield "log", f"{summary.warnings} warnings, {summary.errors} errors"
    mode = ", ".join(filter(None, (summary.mode, summary.flight_controller)))
    if mode:
        yield "mode, flight controller", mode
    if summary.version:
        yield "version", summary.version


def _modes(summary: FlightSummary) -> list[str]:
    rows = [
        (clock_text(each.begin_s), each.mode, duration_text(each.end_s - each.begin_s))
        for each in summary.modes
    ]
    return [table(("from", "mode", "for"), rows, right=(0, 2))] if rows else []


def _gaps(summary: FlightSummary) -> list[str]:
    rows = [(name, duration_text(gap_s)) for name, gap_s in summary.gaps_s.items()]
    return [table(("source", "silent for"), rows, right=(1,))] if rows else []


def _topics(log: FlightLog) -> list[str]:
    seconds = max(log.length_s, 1e-9)
    rows = [
        (topic, str(count), f"{count / seconds:.1f}" if log.length_s else "-")
        for topic, count in sorted(log.topics.items())
    ]
    return [table(("topic", "messages", "a second"), rows, right=(1, 2))] if rows else []


def _pairs(pairs: Iterable[tuple[str, str]]) -> list[str]:
    rows = [(printable(key), printable(value)) for key, value in pairs]
    width = max((len(key) for key, _ in rows), default=0)
    return [f"{key:<{width}}  {value}" for key, value in rows]
