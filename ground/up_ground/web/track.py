"""The way that the aircraft has come."""

from __future__ import annotations

from bisect import bisect_right
from math import cos, radians
from typing import Any

from up_ground.telemetry import Telemetry

POINTS_LIMIT = 4000
NEAREST_M = 2.0
_METRES_A_DEGREE = 111_195.0

Point = tuple[float, float, float | None]


class Track:
    """Points at least ``NEAREST_M`` apart; when there are too many, every second one is left out.

    Degrees, degrees, metres. The newest place is always the last point.
    """

    def __init__(self) -> None:
        self._points: list[Point] = []
        self._times_s: list[float] = []
        self._newest: Point | None = None

    def take(self, telemetry: Telemetry, time_s: float) -> None:
        """Take the place of a frame, where it has one that is one; time only goes on."""
        latitude = telemetry.number("location", "latitude")
        longitude = telemetry.number("location", "longitude")
        if latitude is None or longitude is None or abs(latitude) > 90 or abs(longitude) > 180:
            return
        altitude = telemetry.number("location", "altitude")
        if altitude is None:
            altitude = telemetry.number("altitude")
        self._newest = (latitude, longitude, altitude)
        if not self._points or _distance_m(self._points[-1], self._newest) >= NEAREST_M:
            self._points.append(self._newest)
            self._times_s.append(time_s)
            if len(self._points) >= POINTS_LIMIT:
                del self._points[1:-1:2], self._times_s[1:-1:2]

    def points(self) -> list[Point]:
        """Return the points from the oldest to the newest."""
        if self._newest is None or self._points[-1] == self._newest:
            return list(self._points)
        return [*self._points, self._newest]

    def points_until(self, time_s: float) -> list[Point]:
        """Return the points up to a moment."""
        return self._points[: bisect_right(self._times_s, time_s)]


def track_message(aircraft: str, points: list[Point]) -> dict[str, Any]:
    """Return what a page is told."""
    return {"type": "track", "aircraft": aircraft, "points": points}


def _distance_m(a: Point, b: Point) -> float:
    # Flat is near enough for neighbours; over the date line they are far apart and both are kept.
    north = (b[0] - a[0]) * _METRES_A_DEGREE
    east = (b[1] - a[1]) * _METRES_A_DEGREE * cos(radians(a[0]))
    return float((north * north + east * east) ** 0.5)
