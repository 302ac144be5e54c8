"""Gravity, distances and bearings on a spherical Earth: within 0.6 % of the ellipsoid."""

from math import asin, atan2, cos, degrees, radians, sin, sqrt

MEAN_RADIUS_M = 6_371_008.8
GRAVITY_M_S2 = 9.80665


def distance_m(
    latitude_a: float, longitude_a: float, latitude_b: float, longitude_b: float
) -> float:
    """Return the great-circle distance (haversine) between two points in degrees, in metres."""
    a, b = radians(latitude_a), radians(latitude_b)
    half_latitude = sin((b - a) / 2)
    half_longitude = sin(radians(longitude_b - longitude_a) / 2)
    h = half_latitude**2 + cos(a) * cos(b) * half_longitude**2
    return 2 * MEAN_RADIUS_M * asin(min(1.0, sqrt(h)))


def bearing_deg(
    latitude_a: float, longitude_a: float, latitude_b: float, longitude_b: float
) -> float:
    """Return the initial bearing from a to b, degrees clockwise from north, 0 to 360."""
    a, b = radians(latitude_a), radians(latitude_b)
    east = radians(longitude_b - longitude_a)
    y = sin(east) * cos(b)
    x = cos(a) * sin(b) - sin(a) * cos(b) * cos(east)
    return compass_deg(degrees(atan2(y, x)))


def compass_deg(angle_deg: float) -> float:
    """Return an angle as 0 to less than 360 degrees."""
    turned = angle_deg % 360.0
    # The remainder of a tiny negative number is exactly 360.0.
    return 0.0 if turned == 360.0 else turned
