"""The report of a flight."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from up.fields import printable
from up_simulator.scenario.expectation import Verdict
from up_simulator.scenario.flight_record import FlightRecord
from up_simulator.scenario.result import Result

_HELD, _NOT_HELD = "held", "NOT HELD"
_NAME_WIDTH = 58


def report_lines(name: str, result: Result, files: Iterable[Path] = ()) -> Iterator[str]:
    """Yield the report: the participants, every expectation with figure and limit, the errors.

    Control characters in the scenario's texts never reach the terminal.
    """
    yield from map(printable, _lines(name, result, files))


def _lines(name: str, result: Result, files: Iterable[Path]) -> Iterator[str]:
    record = result.record
    scenario = record.scenario
    yield f"{scenario.title.strip()} ({name})"
    yield from _interrupted(result)
    yield from _flight_lines("flight", record)
    if result.control is not None:
        yield from _flight_lines("control run", result.control)
    if scenario.is_real:
        yield "  real programs and sockets: real time, not repeatable to the digit"
    yield ""
    for verdict in result.verdicts:
        yield from _verdict_lines(verdict)
    yield from _failures(result)
    shown = [str(path) for path in files]
    if shown:
        yield ""
        yield "  " + "  ".join(shown)
    yield ""
    count = len(result.verdicts)
    held = sum(verdict.is_held for verdict in result.verdicts)
    state = "held" if result.is_held else "NOT held"
    yield f"{name}: {state} ({held} of {count} expectations)"


def _interrupted(result: Result) -> Iterator[str]:
    for what, record in (("the flight", result.record), ("the control run", result.control)):
        if record is not None and record.is_interrupted:
            when = f"{record.flown_s:.2f} s of {record.scenario.duration_s:g} s"
            yield f"  INTERRUPTED: {what} was interrupted at {when}"


def speed_text(record: FlightRecord) -> str:
    """Return how long it flew and how fast that was."""
    return (
        f"{record.flown_s:.1f} s in {record.took_s:.1f} s,"
        f" {record.speed:.1f} times as fast as real time"
    )


def _flight_lines(what: str, record: FlightRecord) -> Iterator[str]:
    scenario = record.scenario
    yield (
        f"  {what}: {speed_text(record)}; {scenario.airframe}, seed {scenario.seed},"
        f" {record.board_title}"
    )
    for note in record.notes.values():
        yield f"  {what}: {note}"


def _verdict_lines(verdict: Verdict) -> Iterator[str]:
    mark = _HELD if verdict.is_held else _NOT_HELD
    limit = f"({verdict.limit})" if verdict.limit else ""
    yield f"  {mark:<9}{verdict.name:<{_NAME_WIDTH}} {verdict.figure} {limit}".rstrip()
    if verdict.why:
        yield f"           {verdict.why}"


def _failures(result: Result) -> Iterator[str]:
    for what, record in (("the flight", result.record), ("the control run", result.control)):
        if record is None:
            continue
        if record.failure is not None:
            yield f"  {what} stopped at {record.flown_s:.2f} s: {record.failure}"
            for line in record.failure_log:
                yield f"    | {line}"
        if record.crash is not None:
            yield f"  {what} ended at {record.crash_s:.2f} s: {record.crash}{_position(record)}"


def _position(record: FlightRecord) -> str:
    log = record.log
    if not len(log):
        return ""
    north_m, east_m = log.numbers("truth.north_m")[-1], log.numbers("truth.east_m")[-1]
    north, east = _direction(north_m, "north", "south"), _direction(east_m, "east", "west")
    return f", {north} and {east} of the start"


def _direction(metres: float, positive: str, negative: str) -> str:
    return f"{abs(metres):.0f} m {positive if metres >= 0 else negative}"
