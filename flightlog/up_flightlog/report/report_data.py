"""The data that a report needs from a log, read in a few passes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise
from typing import Any

from up.flight_log.json_message import number_at, value_at
from up.flight_log.origin_text import KEY, link_and_role
from up_flightlog.findings.estimate_error import ORIENTATION
from up_flightlog.findings.flight_context import (
    ALTITUDE,
    ANGLES,
    CHANNELS,
    INPUTS,
    RX,
    FlightContext,
)
from up_flightlog.plots.chart import Band
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.series import Columns, Series
from up_flightlog.read.source_filter import from_selected_source
from up_flightlog.read.telemetry_frames import frames
from up_flightlog.report.demand import DemandSeries

SERVOS = "up.servo.update"
STATUS, STATE = "arduino.status", "up.flight.state"
LOCATION, LINK_STATE = "up.location.update", "up.link.state"
FRAME_FIELDS = (
    *(f"orientation.{name}" for name in ANGLES),
    *(f"rx.{name}" for name in INPUTS),
    *(f"servo.{name}" for name in CHANNELS),
    *("altitude", "android.batteryLevel", "load.cpu", "load.ram", "load.delay_ms"),
    *("arduino.loop_us", "arduino.late_us", "arduino.flight_battery_v"),
)
BOARD_TOPICS = (STATUS, RX, SERVOS, STATE)
PHONE_TOPICS = (LOCATION, ALTITUDE, "up.heading.change", "android.battery")
_MAX_STEPS = 600
_FRAMES = 64
"""Frames in memory together."""
GROUND_LINKS = ("ground", "mission_control")


@dataclass(slots=True)
class ReportData:
    """Series by name; empty if the log does not contain them."""

    log: FlightLog
    attitude: dict[str, Series]
    demand: DemandSeries
    sticks: dict[str, Series]
    servos: dict[str, Series]
    status: dict[str, Series]
    frames: dict[str, Series]
    altitude: Series
    required_altitude: Series
    speed: Series
    truth: dict[str, Series]
    bands: list[Band]
    blocked: Series
    silences: dict[str, Series]


def read_report_data(log: FlightLog, context: FlightContext) -> ReportData:
    """Read it; raises FlightLogError when a file can no longer be read."""
    known, blocked = _from_frames(log)
    attitude, sticks, servos = context.attitude, context.sticks, log.columns(SERVOS, CHANNELS)
    required_altitude = Series()
    for time_s, data in _messages(log, ALTITUDE):
        if data.get("mode") == "required":
            required_altitude.add(time_s, number_at(data, ("altitude",)))
    return ReportData(
        log=log,
        attitude={name: attitude[name] or known[f"orientation.{name}"] for name in ANGLES},
        demand=DemandSeries(log),
        sticks={name: sticks[name] or known[f"rx.{name}"] for name in INPUTS},
        servos={name: servos[name] or known[f"servo.{name}"] for name in CHANNELS},
        status=_of_status(context, ("loop_us", "late_us")),
        frames=known,
        altitude=context.altitude or known["altitude"],
        required_altitude=required_altitude,
        speed=from_selected_source(log, "location", LOCATION, ("speed",))["speed"],
        truth=context.truth,
        bands=list(bands_of(context)),
        blocked=blocked,
        silences=_silences(log),
    )


def bands_of(context: FlightContext) -> Iterator[Band]:
    """Yield the modes and their times; the circle of the receiver's failsafe is a separate one."""
    changes: list[tuple[float, bool | None, str | None]] = [
        *((state.time_s, state.is_failsafe is True, None) for state in context.states),
        *((time_s, None, mode or "") for time_s, mode in context.modes),
    ]
    begin_s, name, mode, is_failsafe = 0.0, "", "", False
    for time_s, failsafe, flown in sorted(changes, key=lambda each: each[0]):
        is_failsafe = is_failsafe if failsafe is None else failsafe
        mode = mode if flown is None else flown
        now = "failsafe" if is_failsafe else mode
        if now != name:
            if name and time_s > begin_s:
                yield Band(begin_s, time_s, name)
            begin_s, name = time_s, now
    if name:
        yield Band(begin_s, context.log.length_s, name)


def _messages(log: FlightLog, *topics: str) -> Iterator[tuple[float, Mapping[str, Any]]]:
    for message in log.messages(*topics):
        yield message.time_s, message.data


def _of_status(context: FlightContext, fields: Sequence[str]) -> dict[str, Series]:
    found, statuses = Columns(fields), context.statuses
    found.add_all([each.time_s for each in statuses], [each.data for each in statuses])
    return found.series


def _from_frames(log: FlightLog) -> tuple[dict[str, Series], Series]:
    """Return the series of telemetry, and how often the event loop was blocked.

    The frames of an hour would take too much memory together: some are read and released. Frames
    that are built from Commands lack the readings that the report takes from those Commands.
    """
    found, blocked = Columns(FRAME_FIELDS), Series()
    read = frames(log, without=(ORIENTATION, RX, SERVOS))
    while some := list(islice(read, _FRAMES)):
        found.add_all([each.time_s for each in some], [each.data for each in some])
        for frame in some:
            reactor = value_at(frame.data, ("counters", "reactor"))
            if isinstance(reactor, dict):
                times = sum(each for each in reactor.values() if type(each) is int)
                blocked.add(frame.time_s, float(times))
    return found.series, blocked


def _silences(log: FlightLog) -> dict[str, Series]:
    """Return the length of the silence around each moment: of board, phone and ground."""
    found = {}
    positions = first_link(log)
    phone = "phone" if positions in ("", "android") else f"positions ({positions})"
    for name, topics in (("board", BOARD_TOPICS), (phone, PHONE_TOPICS)):
        times_s = sorted(
            time_s for topic in topics if topic in log.topics for time_s in log.times(topic)
        )
        if times_s:
            found[name] = _silence(times_s, log.length_s)
    ground = _ground_away(log)
    if ground:
        found["ground"] = ground
    return found


def first_link(log: FlightLog) -> str:
    """Return the link of the first position; empty without one."""
    return next((link_and_role(data.get(KEY))[0] for _, data in _messages(log, LOCATION)), "")


def _silence(times_s: list[float], end_s: float) -> Series:
    """Return the longest silence that overlaps each second (in a long flight: each step)."""
    step_s = max(1.0, end_s / _MAX_STEPS)
    longest: dict[int, float] = {}
    for last_s, next_s in pairwise((*times_s, end_s)):
        for step in range(int(last_s / step_s), int(next_s / step_s) + 1):
            longest[step] = max(longest.get(step, 0.0), next_s - last_s)
    series = Series()
    for step in sorted(longest):
        series.add(step * step_s, longest[step])
    return series


def _ground_away(log: FlightLog) -> Series:
    series = Series()
    connected: dict[str, bool] = {}
    since_s: float | None = None
    for time_s, data in _messages(log, LINK_STATE):
        if data.get("link") not in GROUND_LINKS:
            continue
        connected[data["link"]] = data.get("connected") is True
        is_there = any(connected.values())
        if is_there and since_s is not None:
            series.add(since_s, time_s - since_s)
            since_s = None
        if is_there:
            series.add(time_s, 0.0)
        elif since_s is None:
            since_s = time_s
    if since_s is not None:
        series.add(since_s, log.length_s - since_s)
    if series:
        series.add(log.length_s, series.values[-1])
    return series
