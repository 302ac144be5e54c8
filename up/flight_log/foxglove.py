"""The schemas by which Foxglove recognises a text log and a place on the map.

Source: https://docs.foxglove.dev/docs/sdk/schemas (foxglove.Log, foxglove.LocationFix).
"""

from typing import Any

LOG = "foxglove.Log"
LOCATION_FIX = "foxglove.LocationFix"
PLACE_TOPIC = "/location"
"""The topic of places."""

LOG_LEVELS = {"debug": 1, "info": 2, "warn": 3, "error": 4, "critical": 5}
"""A level of twisted.logger as foxglove.Log's; 0 for an unknown one."""

_TIME: dict[str, Any] = {
    "type": "object",
    "title": "time",
    "properties": {
        "sec": {"type": "integer", "minimum": 0},
        "nsec": {"type": "integer", "minimum": 0, "maximum": 999_999_999},
    },
    "required": ["sec", "nsec"],
}

LOG_SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": LOG,
    "description": "A line of the program's log",
    "type": "object",
    "properties": {
        "timestamp": _TIME,
        "level": {
            "type": "integer",
            "minimum": 0,
            "maximum": 5,
            "description": "0 unknown, 1 debug, 2 info, 3 warning, 4 error, 5 fatal",
        },
        "message": {"type": "string"},
        "name": {"type": "string", "description": "the logger"},
        "file": {"type": "string"},
        "line": {"type": "integer", "minimum": 0},
        "code": {"type": "string", "description": "the kind of event, for programs"},
        "fields": {"type": "object", "properties": {}, "description": "the values of the event"},
    },
    "required": ["timestamp", "level", "message"],
}

LOCATION_FIX_SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": LOCATION_FIX,
    "description": "The position of the aircraft, WGS 84",
    "type": "object",
    "properties": {
        "timestamp": _TIME,
        "frame_id": {"type": "string"},
        "latitude": {"type": "number", "description": "deg"},
        "longitude": {"type": "number", "description": "deg"},
        "altitude": {"type": "number", "description": "m"},
        "position_covariance": {
            "type": "array",
            "items": {"type": "number"},
            "minItems": 9,
            "maxItems": 9,
            "description": "m^2, east, north, up, row by row",
        },
        "position_covariance_type": {
            "type": "integer",
            "minimum": 0,
            "maximum": 3,
            "description": "0 unknown, 1 approximated, 2 diagonal known, 3 known",
        },
    },
    "required": ["timestamp", "latitude", "longitude"],
}


def timestamp(time_ns: int) -> dict[str, int]:
    """Return nanoseconds since 1970 in the schemas' form of a time."""
    sec, nsec = divmod(time_ns, 1_000_000_000)
    return {"sec": sec, "nsec": nsec}


def location_fix(
    time_ns: int,
    latitude_deg: float,
    longitude_deg: float,
    altitude_m: float | None,
    accuracy_m: float | None,
) -> dict[str, Any]:
    """Return a position as Foxglove's map takes it; an accuracy is a radius of 68 %."""
    variance = 0.0 if accuracy_m is None else accuracy_m**2
    content: dict[str, Any] = {
        "timestamp": timestamp(time_ns),
        "frame_id": "",
        "latitude": latitude_deg,
        "longitude": longitude_deg,
        "position_covariance": [variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, variance],
        "position_covariance_type": 1 if variance else 0,
    }
    # An unknown altitude is left out; 0 would mean sea level.
    if altitude_m is not None:
        content["altitude"] = altitude_m
    return content
