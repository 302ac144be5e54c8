"""The aircraft's track and its home."""

from __future__ import annotations

from bisect import bisect_right
from collections import deque
from math import asin, atan2, cos, degrees, radians, sin
from typing import Any

from up.earth import MEAN_RADIUS_M, distance_m
from up_ground.telemetry import Telemetry

POINTS_LIMIT = 4000
MIN_SPACING_M = 2.0
GAP_S = 0.9
"""A longer gap counts as a silence, unless the period of positions is longer."""
_METRES_A_DEGREE = 111_195.0

_INTERVALS = 5

Point = tuple[float, float, float | None] | tuple[float, float, float | None, bool]


class Track:
    """Points at least ``MIN_SPACING_M`` apart; of too many, every second one is dropped.

    Degrees, degrees, metres; and true after a gap, so that no line leads to the point. The newest
    position is always the last point.
    """

    def __init__(self) -> None:
        self._points: list[Point] = []
        self._times_s: list[float] = []
        self._newest: Point | None = None
        self._known_s: float | None = None
        self._intervals_s: deque[float] = deque(maxlen=_INTERVALS)
        self._is_after_silence = False

    def update(self, telemetry: Telemetry, time_s: float) -> None:
        """Take the position of a frame, if it has a valid one; time never runs back."""
        latitude = telemetry.number("location", "latitude")
        longitude = telemetry.number("location", "longitude")
        if latitude is None or longitude is None or abs(latitude) > 90 or abs(longitude) > 180:
            return
        altitude = telemetry.number("location", "altitude")
        if altitude is None:
            altitude = telemetry.number("altitude")
        if not telemetry.is_stale("location", time_s):
            self._is_after_silence |= self._was_silent(time_s)
        self._newest = (latitude, longitude, altitude)
        if not self._points or _distance_m(self._points[-1], self._newest) >= MIN_SPACING_M:
            if self._is_after_silence and self._points:
                self._newest = (latitude, longitude, altitude, True)
            self._is_after_silence = False
            self._points.append(self._newest)
            self._times_s.append(time_s)
            if len(self._points) >= POINTS_LIMIT:
                self._thin()

    def points(self) -> list[Point]:
        if self._newest is None or self._points[-1] == self._newest:
            return list(self._points)
        return [*self._points, self._newest]

    def points_until(self, time_s: float) -> list[Point]:
        return self._points[: bisect_right(self._times_s, time_s)]

    def _was_silent(self, time_s: float) -> bool:
        known_s, self._known_s = self._known_s, time_s
        if known_s is None:
            return False
        period_s = 0.0
        if len(self._intervals_s) == _INTERVALS:
            period_s = sorted(self._intervals_s)[_INTERVALS // 2]
        self._intervals_s.append(time_s - known_s)
        return time_s - known_s > max(GAP_S, 2.5 * period_s)

    def _thin(self) -> None:
        """Drop every second point; the following point keeps the gap mark of a dropped one."""
        points: list[Point] = []
        times_s: list[float] = []
        is_after_silence = False
        last = len(self._points) - 1
        for place, point in enumerate(self._points):
            is_after_silence |= len(point) == 4
            if place % 2 == 0 or place == last:
                points.append((*point[:3], True) if is_after_silence else point)
                times_s.append(self._times_s[place])
                is_after_silence = False
        self._points, self._times_s = points, times_s


def track_message(aircraft: str, points: list[Point]) -> dict[str, Any]:
    """Return the message for a page."""
    return {"type": "track", "aircraft": aircraft, "points": points}


def _distance_m(a: Point, b: Point) -> float:
    # Flat is near enough for neighbours; over the date line they are far apart and both are kept.
    north = (b[0] - a[0]) * _METRES_A_DEGREE
    east = (b[1] - a[1]) * _METRES_A_DEGREE * cos(radians(a[0]))
    return float((north * north + east * east) ** 0.5)


_MOVED_M = 20.0
_MAX_DISTANCE_M = 1e6


class Home:
    """Keeps the first place that was worked out; only a home that moved replaces it."""

    def __init__(self) -> None:
        self._place: tuple[float, float] | None = None

    def update(self, telemetry: Telemetry) -> None:
        latitude = telemetry.number("location", "latitude")
        longitude = telemetry.number("location", "longitude")
        distance = telemetry.number("home", "distance")
        bearing = telemetry.number("home", "bearing")
        if latitude is None or longitude is None or distance is None or bearing is None:
            return
        if abs(latitude) > 90 or abs(longitude) > 180 or not 0 <= distance <= _MAX_DISTANCE_M:
            return
        place = destination(latitude, longitude, bearing, distance)
        if self._place is None or distance_m(*self._place, *place) > _MOVED_M:
            self._place = place

    def position(self) -> dict[str, float] | None:
        if self._place is None:
            return None
        return {"latitude": round(self._place[0], 7), "longitude": round(self._place[1], 7)}


def destination(
    latitude: float, longitude: float, bearing_deg: float, distance: float
) -> tuple[float, float]:
    """Return the point ``distance`` m away on the great circle that begins with that bearing."""
    north, east = radians(latitude), radians(longitude)
    way, turn = distance / MEAN_RADIUS_M, radians(bearing_deg)
    there = asin(sin(north) * cos(way) + cos(north) * sin(way) * cos(turn))
    east += atan2(sin(turn) * sin(way) * cos(north), cos(way) - sin(north) * sin(there))
    return degrees(there), (degrees(east) + 540.0) % 360.0 - 180.0
