"""The track of an aircraft: the values from which every track format is written."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TypeGuard

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
