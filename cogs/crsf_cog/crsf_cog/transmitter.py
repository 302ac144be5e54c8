"""Telemetry as frames for the pilot's transmitter."""

import math
import struct
from collections.abc import Callable

from crsf_cog.frames import ATTITUDE, BATTERY, FLIGHT_MODE, GPS, frame
from up.commands.telemetry_schema import READINGS
from up.telemetry_frame import Frame

MAX_TEXT = 13
"""EdgeTX cuts a longer flight mode."""
_GPS = struct.Struct(">2i3HB")
_BATTERY = struct.Struct(">2H4s")
_NO_FUEL = b"\xff" * 4
"""Drawn mAh and percent; EdgeTX takes bytes of ones for a value that is not known."""


def telemetry_frames(content: Frame) -> bytes:
    """Return the frames of the values that are known and fresh."""
    return b"".join(
        frame(type_, payload)
        for type_, build in _BUILDERS.items()
        if (payload := build(content)) is not None
    )


def _attitude(content: Frame) -> bytes | None:
    age_ms = content.number("age_ms", "orientation")
    if age_ms is None or age_ms > 1000 * READINGS["orientation"].stale_s:
        return None
    roll, pitch, yaw = (content.number("orientation", name) for name in ("roll", "pitch", "yaw"))
    angles_deg = (pitch, roll, _first(content.number("navigation", "heading"), yaw))
    angles = (math.remainder(math.radians(each or 0.0), math.tau) for each in angles_deg)
    return struct.pack(">3h", *(int(each * 10_000) for each in angles))


def _gps(content: Frame) -> bytes | None:
    position = content.position
    if position is None:
        return None
    altitudes_m = (content.number(part, "altitude") for part in ("navigation", "location"))
    altitude_m, course_deg = _first(*altitudes_m), content.number("navigation", "course")
    return _GPS.pack(
        *(round(each * 1e7) for each in position),
        _bounded(content.number("navigation", "speed"), 36, 0xFFFF),
        _bounded(None if course_deg is None else course_deg % 360, 100, 0xFFFF),
        _bounded(None if altitude_m is None else altitude_m + 1000, 1, 0xFFFF),
        _bounded(content.number("location", "satellites"), 1, 0xFF),
    )


def _battery(content: Frame) -> bytes | None:
    voltage_v = content.number("arduino", "flight_battery_v")
    if voltage_v is None:
        return None
    current_a = content.number("arduino", "flight_battery_a")
    return _BATTERY.pack(_bounded(voltage_v, 10, 0xFFFF), _bounded(current_a, 10, 0xFFFF), _NO_FUEL)


def _flight_mode(content: Frame) -> bytes | None:
    """Return the name of the flight mode; a star after it: not armed."""
    if not content.mode:
        return None
    star = "" if content.flag("armed") else "*"
    text = content.mode[: MAX_TEXT - len(star)] + star
    return text.encode("ascii", "replace") + b"\0"


def _first(*values: float | None) -> float | None:
    return next((each for each in values if each is not None), None)


def _bounded(value: float | None, factor: int, unknown: int) -> int:
    """Return a value in units of 1 / factor; the greatest number stands for an unknown one."""
    return unknown if value is None else max(0, min(unknown - 1, round(value * factor)))


_BUILDERS: dict[int, Callable[[Frame], bytes | None]] = {
    ATTITUDE: _attitude,
    GPS: _gps,
    BATTERY: _battery,
    FLIGHT_MODE: _flight_mode,
}
