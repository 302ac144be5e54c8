"""Telemetry as MAVLink messages: one function for each message, None while it has no content."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

from up.commands.telemetry_schema import READINGS
from up.telemetry_frame import Frame
from up.version import VERSION
from up_mavlink.modes import number_of
from up_mavlink.personas import Persona

FIXED_WING = 1
CUSTOM_MODE, ARMED = 1, 128
STANDBY, ACTIVE, CRITICAL = 3, 4, 5
GYRO_ACCELEROMETER, PRESSURE, GPS, RECEIVER, ATTITUDE, FENCE, BATTERY, PREARM_CHECK = (
    3, 8, 32, 1 << 16, 1 << 21, 1 << 20, 1 << 25, 1 << 28
)  # fmt: skip
"""Bits of SYS_STATUS."""
CAPABILITIES = 2 | 4 | 8 | 8192 | 16384
"""Float parameters, MISSION_INT, COMMAND_INT, MAVLink 2, mission type fence."""
NO_MISSION, NOT_STARTED, MISSION_ACTIVE, PAUSED, COMPLETE = 1, 2, 3, 4, 5
U16 = 65535
_CHANNELS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")


def heartbeat(m: Any, frame: Frame, persona: Persona) -> Any:
    """Return HEARTBEAT: mode, armed, state."""
    is_flying = frame.flag("in_flight")
    state = ACTIVE if is_flying else STANDBY
    if frame.flag("arduino", "failsafe") or frame.text("failsafe", "cause"):
        state = CRITICAL
    mode = number_of(persona, frame, frame.mode)
    base = CUSTOM_MODE | (ARMED if frame.flag("armed") else 0)
    return m.MAVLink_heartbeat_message(FIXED_WING, persona.autopilot, base, mode, state, 3)


def _sys_status(m: Any, frame: Frame) -> Any:
    present = GYRO_ACCELEROMETER | RECEIVER | ATTITUDE | PREARM_CHECK
    health = 0
    checks = {
        GYRO_ACCELEROMETER | ATTITUDE: frame.flag("arduino", "imu_valid"),
        RECEIVER: frame.flag("arduino", "receiver_valid"),
        PREARM_CHECK: frame.texts("vetoes") == [],
    }
    for bits, is_valid in checks.items():
        health |= bits if is_valid else 0
    # Without a fence none is breached.
    if (frame.number("fence", "margin") or 0.0) >= 0.0:
        health |= FENCE
    optional = {
        GPS: (frame.number("age_ms", "location"), frame.position is not None),
        PRESSURE: (frame.number("altitude"), True),
        FENCE: (frame.number("fence", "count") or None, False),
        BATTERY: (_voltage_v(frame), frame.flag("arduino", "flight_battery_low") is not True),
    }
    for bits, (value, is_valid) in optional.items():
        present |= bits if value is not None else 0
        health |= bits if value is not None and is_valid else 0
    load = round(10 * (frame.number("load", "cpu") or 0.0))
    millivolts = _millivolts(frame)
    return m.MAVLink_sys_status_message(
        present, present, health, _bounded(load, 0, 1000), millivolts, -1, -1, 0, 0, 0, 0, 0, 0
    )


def _attitude(m: Any, frame: Frame) -> Any:
    angles = [frame.number("orientation", name) for name in ("roll", "pitch", "yaw")]
    if None in angles or frame.is_stale("orientation"):
        return None
    rates = [frame.number("rates", name) or 0.0 for name in ("roll", "pitch", "yaw")]
    roll, pitch, yaw = (math.radians(each or 0.0) for each in angles)
    yaw = math.remainder(yaw, math.tau)
    return m.MAVLink_attitude_message(frame.clock_ms, roll, pitch, yaw, *map(math.radians, rates))


def _global_position_int(m: Any, frame: Frame) -> Any:
    if (position := frame.position) is None:
        return None
    speed, course = frame.number("navigation", "speed"), frame.number("navigation", "course")
    north = east = 0.0
    if speed is not None and course is not None:
        north, east = speed * math.cos(math.radians(course)), speed * math.sin(math.radians(course))
    heading = _heading(frame)
    return m.MAVLink_global_position_int_message(
        frame.clock_ms, *_degrees(position), _mm(_altitude(frame)), _mm(_height(frame)),
        _short(100 * north), _short(100 * east),
        _short(-100 * (frame.number("navigation", "climb") or 0.0)),
        U16 if heading is None else round(heading * 100) % 36000,
    )  # fmt: skip


def _gps_raw_int(m: Any, frame: Frame) -> Any:
    age_ms = frame.number("age_ms", "location")
    satellites = frame.number("location", "satellites")
    has_fix = age_ms is not None and age_ms <= 1000 * READINGS["location"].stale_s
    fields = (frame.number("location", "latitude"), frame.number("location", "longitude"))
    latitude, longitude = (each or 0.0 for each in fields)
    speed, course = frame.number("navigation", "speed"), frame.number("navigation", "course")
    return m.MAVLink_gps_raw_int_message(
        frame.clock_ms * 1000, 3 if has_fix else 1, *_degrees((latitude, longitude)),
        _mm(frame.number("location", "altitude")), U16, U16,
        U16 if speed is None else _bounded(round(speed * 100), 0, U16 - 1),
        U16 if course is None else round(course * 100) % 36000,
        255 if satellites is None else _bounded(round(satellites), 0, 254),
    )  # fmt: skip


def _vfr_hud(m: Any, frame: Frame) -> Any:
    throttle_us = frame.number("servo", "throttle")
    throttle = 0 if throttle_us is None else _bounded(round((throttle_us - 1000) / 10), 0, 100)
    heading = _heading(frame)
    return m.MAVLink_vfr_hud_message(
        frame.number("navigation", "airspeed") or 0.0,
        frame.number("navigation", "speed") or 0.0,
        -1 if heading is None else round(heading) % 360,
        throttle,
        _altitude(frame) or 0.0,
        frame.number("navigation", "climb") or 0.0,
    )


def _rc_channels(m: Any, frame: Frame) -> Any:
    inputs = _pulses(frame, "rx", _CHANNELS)
    if inputs is None:
        return None
    rest = [U16] * (18 - len(inputs))
    return m.MAVLink_rc_channels_message(frame.clock_ms, len(inputs), *inputs, *rest, 255)


def _servo_output_raw(m: Any, frame: Frame) -> Any:
    outputs = _pulses(frame, "servo", _CHANNELS[:4])
    if outputs is None:
        return None
    boot_us = frame.clock_ms * 1000 & 0xFFFFFFFF
    return m.MAVLink_servo_output_raw_message(boot_us, 0, *outputs, 0, 0, 0, 0)


def _battery_status(m: Any, frame: Frame) -> Any:
    if _voltage_v(frame) is None:
        return None
    state = 2 if frame.flag("arduino", "flight_battery_low") else 1
    state = 3 if frame.flag("arduino", "flight_battery_critical") else state
    voltages = [_millivolts(frame)] + [U16] * 9
    return m.MAVLink_battery_status_message(0, 1, 1, 32767, voltages, -1, -1, -1, -1, 0, state)


def _home_position(m: Any, frame: Frame) -> Any:
    if (home := _home(frame)) is None:
        return None
    nowhere = (0.0, 0.0, 0.0, [1.0, 0.0, 0.0, 0.0], 0.0, 0.0, 0.0)
    return m.MAVLink_home_position_message(*home, *nowhere, frame.clock_ms * 1000)


def _gps_global_origin(m: Any, frame: Frame) -> Any:
    home = _home(frame)
    return None if home is None else m.MAVLink_gps_global_origin_message(*home)


def _extended_sys_state(m: Any, frame: Frame) -> Any:
    landed = {True: 2, False: 1, None: 0}[frame.flag("in_flight")]
    return m.MAVLink_extended_sys_state_message(0, landed)


def _system_time(m: Any, frame: Frame) -> Any:
    return m.MAVLink_system_time_message(round(time.time() * 1e6), frame.clock_ms)


def _autopilot_version(m: Any, frame: Frame) -> Any:
    numbers = [int(each) for each in VERSION.split(".")[:3] if each.isdigit()]
    number = sum(each << shift for each, shift in zip(numbers, (24, 16, 8), strict=False))
    return m.MAVLink_autopilot_version_message(
        CAPABILITIES, number, 0, 0, 0, [0] * 8, [0] * 8, [0] * 8, 0, 0, 0
    )


def mission_state(frame: Frame) -> int:
    """Return the state for MISSION_CURRENT."""
    if not frame.number("mission", "count"):
        return NO_MISSION
    if frame.flag("mission", "is_finished"):
        return COMPLETE
    if frame.mode == "MISSION" or frame.text("flight_control", "selected") == "MISSION":
        return MISSION_ACTIVE if frame.mode in ("MISSION", "TAKEOFF") else PAUSED
    return PAUSED if frame.flag("in_flight") else NOT_STARTED


Build = Callable[[Any, Frame], Any]
BUILDERS: dict[str, tuple[Build, float | None]] = {
    "SYS_STATUS": (_sys_status, 1.0),
    "ATTITUDE": (_attitude, 0.25),
    "GLOBAL_POSITION_INT": (_global_position_int, 0.25),
    "GPS_RAW_INT": (_gps_raw_int, 0.5),
    "VFR_HUD": (_vfr_hud, 0.25),
    "RC_CHANNELS": (_rc_channels, 0.5),
    "SERVO_OUTPUT_RAW": (_servo_output_raw, 0.5),
    "BATTERY_STATUS": (_battery_status, 1.0),
    "HOME_POSITION": (_home_position, 5.0),
    "EXTENDED_SYS_STATE": (_extended_sys_state, 1.0),
    "SYSTEM_TIME": (_system_time, 1.0),
    "GPS_GLOBAL_ORIGIN": (_gps_global_origin, None),
    "AUTOPILOT_VERSION": (_autopilot_version, None),
}
"""Each message with its interval in seconds until a ground sets another; None: on request."""


def _pulses(frame: Frame, part: str, names: tuple[str, ...]) -> list[int] | None:
    pulses = [frame.number(part, name) for name in names]
    if pulses[0] is None or frame.is_stale(part):
        return None
    return [0 if each is None else _bounded(round(each), 0, U16 - 1) for each in pulses]


def _voltage_v(frame: Frame) -> float | None:
    return frame.number("arduino", "flight_battery_v")


def _millivolts(frame: Frame) -> int:
    voltage_v = _voltage_v(frame)
    return U16 if voltage_v is None else _bounded(round(voltage_v * 1000), 0, U16 - 1)


def _altitude(frame: Frame) -> float | None:
    known = (frame.number("navigation", "altitude"), frame.number("location", "altitude"))
    return next((each for each in known if each is not None), None)


def _height(frame: Frame) -> float | None:
    height, altitude = frame.number("navigation", "height"), _altitude(frame)
    home = frame.number("home", "altitude")
    if height is None and altitude is not None and home is not None:
        return altitude - home
    return height


def _heading(frame: Frame) -> float | None:
    heading = frame.number("navigation", "heading")
    return frame.number("orientation", "yaw") if heading is None else heading


def _home(frame: Frame) -> tuple[int, int, int] | None:
    latitude, longitude = frame.number("home", "latitude"), frame.number("home", "longitude")
    if latitude is None or longitude is None:
        return None
    return (*_degrees((latitude, longitude)), _mm(frame.number("home", "altitude")))


def _degrees(position: tuple[float, float]) -> tuple[int, int]:
    latitude, longitude = position
    return _int32(latitude * 1e7), _int32(longitude * 1e7)


def _mm(metres: float | None) -> int:
    return _int32((metres or 0.0) * 1000)


def _int32(value: float) -> int:
    return _bounded(round(value), -(2**31), 2**31 - 1)


def _short(value: float) -> int:
    return _bounded(round(value), -32768, 32767)


def _bounded(value: int, least: int, greatest: int) -> int:
    return max(least, min(greatest, value))
