"""The payloads of the serial line as values, both directions (docs/protocols.md 2.3 and 2.4)."""

import math
from struct import Struct

OUTPUTS = Struct(">4H")
"""`r`: us ailerons, elevator, throttle, rudder."""

INPUTS = Struct(">6HB")
"""`i`: us ailerons, elevator, throttle, rudder, aux1, aux2; a validity bit for each."""

ATTITUDE = Struct(">3f")
"""`o`: deg yaw, pitch, roll."""

ORIENTATION = Struct(">H6f")
"""`O`: sequence; deg yaw, pitch, roll; deg/s yaw, pitch, roll rate."""

OUTPUT = Struct(">5H")
"""`u`: us ailerons, elevator, throttle, rudder; sequence of the orientation."""

_SETPOINT = Struct(">3h2H")
_AIRSPEED = Struct(">H")
_LOCATION = Struct(">2f")
_PANIC = Struct(">Bh")
_I16 = Struct(">h")
_U16 = Struct(">H")

_MIN_I16, _MAX_I16, _MAX_U16 = -32768, 32767, 65535
_CENTI = 100
_MIN_AIRSPEED_M_S, _MAX_AIRSPEED_M_S = 5, 40


IN_FLIGHT = "in flight means armed, or without a motor and the receiver received since power-on"


def pack_panic(panic: bool, delay_ms: int) -> bytes:
    """Return the payload of `p`; raises ValueError unless `delay_ms` is 10 to 1000."""
    if not 10 <= delay_ms <= 1000:
        raise ValueError(f"a panic delay is 10 to 1000 ms, not {delay_ms}")
    return _PANIC.pack(bool(panic), delay_ms)


def pack_altitude(altitude_m: float) -> bytes:
    """Return the payload of `h`: rounded half up, clamped to 16 bits; ValueError for NaN."""
    return _I16.pack(min(max(_half_up(altitude_m), _MIN_I16), _MAX_I16))


def pack_heading(heading_deg: float) -> bytes:
    """Return the payload of `b` and `B`: rounded half up, 0 to 359; ValueError for NaN."""
    return _I16.pack(_half_up(heading_deg) % 360)


def pack_location(latitude_deg: float, longitude_deg: float) -> bytes:
    """Return the payload of `l`; ValueError for an invalid position."""
    if not (-90 <= latitude_deg <= 90 and -180 <= longitude_deg <= 180):
        raise ValueError(f"no place: {latitude_deg}, {longitude_deg}")
    return _LOCATION.pack(latitude_deg, longitude_deg)


def pack_voltage(voltage_v: float) -> bytes:
    """Return the payload of `V`; raises ValueError for a voltage outside 0 to 65.535."""
    if not 0 <= voltage_v <= _MAX_U16 / 1000:
        raise ValueError(f"a voltage is 0 to {_MAX_U16 / 1000:g} V, not {voltage_v}")
    return _U16.pack(round(voltage_v * 1000))


def pack_airspeed(airspeed_m_s: float) -> bytes | None:
    """Return the payload of `A`; None for an airspeed that the board refuses."""
    if not _MIN_AIRSPEED_M_S <= airspeed_m_s <= _MAX_AIRSPEED_M_S:
        return None
    return _AIRSPEED.pack(round(airspeed_m_s * _CENTI))


def pack_setpoint(
    roll_deg: float,
    pitch_deg: float,
    yaw_rate_deg_s: float,
    throttle_us: int | None,
    lifetime_ms: int,
) -> bytes:
    """Return the payload of `S` and `R`; a throttle of None leaves it to the stick.

    Raises ValueError for a value that is not finite or out of the range of its field.
    """
    throttle = throttle_us or 0
    if throttle and not 1000 <= throttle <= 2000:
        raise ValueError(f"a throttle is 1000 to 2000 us, not {throttle}")
    if not 1 <= lifetime_ms <= 250:
        raise ValueError(f"a setpoint lives 1 to 250 ms, not {lifetime_ms}")
    return _SETPOINT.pack(
        _centi(roll_deg, 180), _centi(pitch_deg, 90), _centi(yaw_rate_deg_s, 327), throttle,
        lifetime_ms,
    )  # fmt: skip


def _half_up(value: float) -> int:
    if not math.isfinite(value):
        raise ValueError(f"{value} is not finite")
    return math.floor(value + 0.5)


def _centi(value: float, most: float) -> int:
    if not -most <= value <= most:
        raise ValueError(f"{value} is not within {most}")
    return round(value * _CENTI)
