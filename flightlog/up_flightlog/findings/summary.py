"""A flight on one page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from up.commands import board_status
from up.flight_log.json_message import number_at
from up_flightlog.findings.all_checks import findings
from up_flightlog.findings.estimate_error import EstimateError
from up_flightlog.findings.finding import Finding
from up_flightlog.findings.flight_context import (
    ALTITUDE,
    ERROR,
    RX,
    TELEMETRY,
    WARNING,
    FlightContext,
)
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.spans import Span
from up_flightlog.read.track_statistics import track_statistics

__all__ = ["Finding", "FlightSummary", "Mark", "ModeSpan", "findings", "summarise"]

SOURCES: dict[str, str] = {
    "orientation": "up.orientation.update",
    "rx": RX,
    "servo": "up.servo.update",
    "location": "up.location.update",
    "altitude": ALTITUDE,
    "heading": "up.heading.change",
    "battery": "android.battery",
    "telemetry": TELEMETRY,
}
"""Readings whose longest gap is reported, by their names in telemetry."""
BATTERY = "android.battery"
MARK = "black_box.mark"
_MAX_VETOES = 100


@dataclass(frozen=True, slots=True)
class ModeSpan:
    """A span flown in one mode; times in s."""

    mode: str
    begin_s: float
    end_s: float


@dataclass(frozen=True, slots=True)
class Mark:
    """An event that the ground recorded."""

    time_s: float
    text: str


@dataclass(frozen=True, slots=True)
class FlightSummary:
    """The summary of a flight; values missing in the log: None or empty.

    Altitudes are above sea level. ``gaps_s`` is the longest silence of each source that sent data.
    ``vetoes`` lists every arming veto of the flight. ``warnings`` and ``errors`` count lines of the
    program's log.
    """

    start_unix_s: float
    length_s: float
    aircraft: str
    version: str
    mode: str
    flight_controller: str
    armed: list[Span]
    modes: list[ModeSpan]
    highest_m: float | None
    lowest_m: float | None
    top_speed_m_s: float | None
    track_m: float | None
    farthest_m: float | None
    lowest_battery_percent: float | None
    lowest_flight_battery_v: float | None
    estimate_errors: list[EstimateError]
    gaps_s: dict[str, float]
    failsafes: list[Span]
    vetoes: list[str]
    marks: list[Mark]
    warnings: int
    errors: int
    messages: int
    is_complete: bool

    @property
    def armed_s(self) -> float:
        return sum(span.length_s for span in self.armed)


def summarise(log: FlightLog, context: FlightContext | None = None) -> FlightSummary:
    """Return the summary of a flight; ``context`` avoids a second pass (see `findings`)."""
    context = context or FlightContext(log)
    flight = log.metadata.get("flight", {})
    track = track_statistics(log)
    heights_m = list(context.altitude.values) or [
        each for each in (track.lowest_m, track.highest_m) if each is not None
    ]
    levels = [line.level for line in context.log_lines]
    # 0: unknown.
    batteries_mv = (number_at(each.data, ("battery_mv",)) for each in context.statuses)
    voltages_v = [mv / 1000 for mv in batteries_mv if mv]
    return FlightSummary(
        start_unix_s=log.start_unix_s,
        length_s=log.length_s,
        aircraft=flight.get("aircraft", ""),
        version=flight.get("version", ""),
        mode=flight.get("mode", ""),
        flight_controller=flight.get("flight_controller", ""),
        armed=context.armed,
        modes=list(_modes(context)),
        highest_m=max(heights_m, default=None),
        lowest_m=min(heights_m, default=None),
        top_speed_m_s=track.top_speed_m_s,
        track_m=track.length_m,
        farthest_m=track.farthest_m,
        lowest_battery_percent=min(log.series(BATTERY, "level")[1], default=None),
        lowest_flight_battery_v=min(voltages_v, default=None),
        estimate_errors=context.estimate_errors,
        gaps_s=dict(_gaps_s(log)),
        failsafes=context.spans((each.time_s, each.is_failsafe is True) for each in context.states),
        vetoes=_vetoes(context),
        marks=[Mark(each.time_s, str(each.data.get("text"))) for each in log.messages(MARK)],
        warnings=levels.count(WARNING),
        errors=sum(level >= ERROR for level in levels),
        messages=sum(log.topics.values()),
        is_complete=log.is_complete,
    )


def _modes(context: FlightContext) -> Iterator[ModeSpan]:
    ends_s = [*(time_s for time_s, _ in context.modes[1:]), context.log.length_s]
    for (begin_s, mode), end_s in zip(context.modes, ends_s, strict=False):
        if mode is not None:
            yield ModeSpan(mode, begin_s, end_s)


def _gaps_s(log: FlightLog) -> Iterator[tuple[str, float]]:
    for name, topic in SOURCES.items():
        if log.topics.get(topic):
            yield name, log.longest_gap_s(topic)


def _vetoes(context: FlightContext) -> list[str]:
    """Return the board's and the program's vetoes in the order of their first report."""
    seen: dict[str, None] = {}
    for each in _reported_vetoes(context):
        seen[each] = None
        if len(seen) >= _MAX_VETOES:
            break
    return list(seen)


def _reported_vetoes(context: FlightContext) -> Iterator[str]:
    for _, vetoes in context.telemetry("vetoes"):
        if isinstance(vetoes, list):
            yield from (each for each in vetoes if isinstance(each, str))
    for status in context.statuses:
        yield from (f"arduino: {each}" for each in board_status.vetoes_of(status.data))
