"""Where the aircraft's home is, worked out from its place, its distance and its way home."""

from __future__ import annotations

from math import asin, atan2, cos, degrees, radians, sin

from up.earth import MEAN_RADIUS_M, distance_m
from up_ground.telemetry import Telemetry

_MOVED_M = 20.0
_FARTHEST_M = 1e6


class Home:
    """Keeps the first place that was worked out; only a home that moved replaces it."""

    def __init__(self) -> None:
        self._place: tuple[float, float] | None = None

    def take(self, telemetry: Telemetry) -> None:
        """Take a frame."""
        latitude = telemetry.number("location", "latitude")
        longitude = telemetry.number("location", "longitude")
        distance = telemetry.number("home", "distance")
        bearing = telemetry.number("home", "bearing")
        if latitude is None or longitude is None or distance is None or bearing is None:
            return
        if abs(latitude) > 90 or abs(longitude) > 180 or not 0 <= distance <= _FARTHEST_M:
            return
        place = destination(latitude, longitude, bearing, distance)
        if self._place is None or distance_m(*self._place, *place) > _MOVED_M:
            self._place = place

    def told(self) -> dict[str, float] | None:
        """Return the home position in the form sent to pages."""
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
