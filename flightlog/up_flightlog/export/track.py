"""The track of a flight: the values from which every track format is written."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TypeGuard
from xml.sax.saxutils import escape

from up.flight_log.json_message import number_at
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.frame_state import place_of
from up_flightlog.read.track_statistics import fixes

LOCATION, TELEMETRY, MARK = "up.location.update", "up.telemetry.update", "black_box.mark"
# XML 1.0, 2.2: the permitted characters; the rest cannot even be written as a reference.
_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
GAP_S = 10.0
"""After a gap this long a track continues in a new segment."""


@dataclass(frozen=True, slots=True)
class TrackPoint:
    """A position (WGS 84), its time, and other known values; None is unknown."""

    unix_s: float
    latitude_deg: float
    longitude_deg: float
    altitude_m: float | None = None
    speed_m_s: float | None = None
    bearing_deg: float | None = None


@dataclass(frozen=True, slots=True)
class Place:
    """A named point beside the track: the home or a user's mark."""

    point: TrackPoint
    name: str


@dataclass(frozen=True, slots=True)
class Track:
    """The segments of one flight, its name and its waypoints."""

    name: str
    description: str
    segments: Sequence[Sequence[TrackPoint]]
    places: Sequence[Place] = ()


def is_on_earth(point: TrackPoint) -> bool:
    """Return whether the point can be drawn: finite and within the globe."""
    latitude, longitude = point.latitude_deg, point.longitude_deg
    return abs(latitude) <= 90 and abs(longitude) <= 180


def segments_of(points: Iterable[TrackPoint], gap_s: float = GAP_S) -> Iterator[list[TrackPoint]]:
    """Yield the points split at gaps of ``gap_s``; impossible ones are dropped."""
    segment: list[TrackPoint] = []
    for point in points:
        if not is_on_earth(point):
            continue
        if segment and point.unix_s - segment[-1].unix_s >= gap_s:
            yield segment
            segment = []
        segment.append(point)
    if segment:
        yield segment


def utc_text(unix_s: float) -> str | None:
    """Return a time as 2026-05-01T12:00:00.250Z; None outside the calendar's range."""
    try:
        moment = datetime.fromtimestamp(unix_s, UTC)
    except (OverflowError, ValueError, OSError):
        return None
    return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")


def degrees_text(degrees: float) -> str:
    """Return degrees with 7 decimals (a centimetre), without an exponent."""
    return f"{degrees:.7f}"


def longitude_text(degrees: float) -> str:
    """Return a longitude from -180 to below 180."""
    text = degrees_text(degrees)
    return "-180.0000000" if text == "180.0000000" else text


def is_known(value: float | None) -> TypeGuard[float]:
    """Return whether there is a finite value."""
    return value is not None and math.isfinite(value)


def points_of(log: FlightLog) -> Iterator[TrackPoint]:
    """Yield the positions of the followed source in the order of time.

    Without a logged source these are telemetry's; a repeated position counts once.
    """
    start = log.start_unix_s
    if LOCATION in log.topics:
        for fix in fixes(log):
            place = (fix.latitude_deg, fix.longitude_deg, fix.altitude_m, fix.speed_m_s)
            yield TrackPoint(start + fix.time_s, *place)
        return
    last = None
    for message in log.messages(TELEMETRY):
        location = message.data.get("location")
        found = place_of(location) if isinstance(location, dict) and location != last else None
        if found is not None:
            last = location
            yield TrackPoint(start + message.time_s, *found, number_at(location, ("altitude",)))


def track_of(log: FlightLog, name: str, description: str) -> Track:
    """Return the track, with the first position as the home, and the marks at their positions."""
    segments = list(segments_of(points_of(log)))
    places = []
    if segments:
        places.append(Place(segments[0][0], "home"))
        places += _marks(log, [point for segment in segments for point in segment])
    return Track(name, description, segments, places)


def _marks(log: FlightLog, points: list[TrackPoint]) -> Iterator[Place]:
    at = 0
    for message in log.messages(MARK):
        unix_s = log.start_unix_s + message.time_s
        while at + 1 < len(points) and points[at + 1].unix_s <= unix_s:
            at += 1
        text = message.data.get("text")
        yield Place(points[at], text if isinstance(text, str) and text else "mark")


def xml_text(text: str) -> str:
    """Return the text with markup escaped and every character that XML forbids replaced."""
    return escape(_FORBIDDEN.sub("\ufffd", text).replace("\r", "\n"))
