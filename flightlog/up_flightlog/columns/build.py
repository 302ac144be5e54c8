"""Makes the columns of a flight in one pass over its log."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict
from hashlib import blake2b
from pathlib import Path
from typing import Any

from up.flight_log.origin_text import KEY, link_and_role
from up_flightlog.columns.column_file import ColumnWriter
from up_flightlog.export.track import points_of
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.findings.summary import findings
from up_flightlog.plots.chart import is_drawable, usual_gap_s
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.schema_fields import unit_of
from up_flightlog.read.series import Series
from up_flightlog.report.events import events_of
from up_flightlog.report.ground_track import offsets_m
from up_flightlog.report.report_data import bands_of

FORMAT = 1
MAX_COLUMNS = 3000
TRACK = ("track.east_m", "track.north_m")
"""The position of the followed source in metres from its first one."""
_SILENT = ("log", "/location")
"""Texts, and Foxglove's copy of the position."""
_LEVELS = {"bad": "alarm"}

Key = tuple[str, str, str]
"""Topic, field, and the kind of message: its link, and whether its values are required ones."""


def build_columns(log: FlightLog, path: Path, state: Any) -> None:
    """Write the columns of a flight to a file.

    ``state`` identifies the log's files; `ColumnFile.about` has it. Times and values that no axis
    can show are left out. Raises FlightLogError, CliError.
    """
    writer = ColumnWriter()
    found = _read(log)
    kinds: dict[tuple[str, str], int] = {}
    for topic, field, _ in found:
        kinds[topic, field] = kinds.get((topic, field), 0) + 1
    shared: dict[bytes, tuple[array[float], float]] = {}
    for (topic, field, kind), series in found.items():
        suffix = f" [{kind}]" if kinds[topic, field] > 1 else ""
        name = f"{topic}.{field}{suffix}"
        _add(writer, shared, name, unit_of(log.schema(topic), field), series)
    for name, series in zip(TRACK, _track(log), strict=True):
        if series:
            _add(writer, shared, name, "m", series)
    context = FlightContext(log)
    armed = next((span.begin_s for span in context.armed), None)
    writer.write(
        path,
        {
            "format": FORMAT,
            "state": state,
            "start_unix_s": log.start_unix_s,
            "length_s": log.length_s,
            "aircraft": log.metadata.get("flight", {}).get("aircraft", ""),
            "armed_s": armed,
            "bands": [asdict(each) for each in bands_of(context)],
            "events": _events(log, context),
        },
    )


def _add(
    writer: ColumnWriter,
    shared: dict[bytes, tuple[array[float], float]],
    name: str,
    unit: str,
    series: Series,
) -> None:
    """Add a column; the values of one topic mostly have the same times."""
    key = blake2b(series.times_s).digest()
    times_s, gap_s = shared.get(key) or (series.times_s, usual_gap_s(series.times_s))
    shared[key] = times_s, gap_s
    writer.add(name, unit, gap_s, times_s, array("f", series.values))


def _read(log: FlightLog) -> dict[Key, Series]:
    found: dict[Key, Series] = {}
    adders: dict[tuple[str, str, Any], dict[str, Callable[[float, float], None] | None]] = {}
    topics = [topic for topic in log.topics if topic not in _SILENT]
    for message in log.messages(*topics) if topics else ():
        data, time_s = message.data, message.time_s
        kind = (message.topic, str(data.get(KEY)), data.get("mode") == "required")
        known = adders.get(kind)
        if known is None:
            known = adders[kind] = {}
        for field, value in _numbers(data, ""):
            if field not in known:
                known[field] = _adder(found, kind, field)
            add = known[field]
            if add is not None and is_drawable(value):
                add(time_s, value)
    return {key: series for key, series in found.items() if series}


def _adder(
    found: dict[Key, Series], kind: tuple[str, str, bool], field: str
) -> Callable[[float, float], None] | None:
    topic, origin, is_required = kind
    name = link_and_role(origin)[0] + (", required" if is_required else "")
    series = found.get((topic, field, name))
    if series is None:
        if len(found) >= MAX_COLUMNS:
            return None
        series = found[topic, field, name] = Series(values=array("f"))
    return series.add


def _numbers(data: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, float]]:
    """Yield the numbers of a message by dotted paths; yes is 1 and no is 0."""
    for key, value in data.items():
        kind = type(value)
        if kind is float or kind is int or kind is bool:
            yield prefix + key, value
        elif kind is dict:
            yield from _numbers(value, f"{prefix}{key}.")


def _track(log: FlightLog) -> Sequence[Series]:
    east, north = Series(), Series()
    home = None
    for point in points_of(log):
        place = (point.latitude_deg, point.longitude_deg)
        home = home or place
        east_m, north_m = offsets_m(*place, *home)
        east.add(point.unix_s - log.start_unix_s, east_m)
        north.add(point.unix_s - log.start_unix_s, north_m)
    return east, north


def _events(log: FlightLog, context: FlightContext) -> list[dict[str, Any]]:
    """Return events and findings in the order of time."""
    found = [(e.time_s, e.level, e.code, e.text) for e in events_of(log, context)]
    found += [(e.time_s, e.level, e.code, e.text) for e in findings(log, context)]
    return [
        {"time_s": time_s, "level": _LEVELS.get(level, level), "code": code, "text": text}
        for time_s, level, code, text in sorted(found)
    ]
