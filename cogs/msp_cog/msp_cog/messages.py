"""The messages of MSP that the cog uses, as Betaflight's ``msp.c`` (API 1.43 and later) has them.

Each reader raises ``struct.error`` or ``ValueError`` for a payload that is too short.
"""

import struct
from collections.abc import Mapping, Sequence

from msp_cog.stick_curve import StickCurve
from up.commands.flight_state_command import FlightBatteryCommand
from up.commands.location_command import LocationCommand
from up.quick_dataclass import dataclass

VARIANT, VERSION, RECEIVER_MAP, ADVANCED, STATUS = 2, 3, 64, 94, 150
RAW_IMU, SERVO, MOTOR, RC = 102, 103, 104, 105
RAW_GPS, ATTITUDE, ANALOG, RC_TUNING, BOX_IDS, DEADBAND = 106, 108, 110, 111, 119, 125
SET_RAW_RC, SET_ARMING_DISABLED = 200, 99
SETTINGS = (VARIANT, VERSION, RECEIVER_MAP, RC_TUNING, DEADBAND, ADVANCED)
"""What decides whether set-points may be sent, and how."""
OLDEST_VERSION = bytes((26, 6))
"""2026.6: an older board holds the last set-point when no other follows."""
AETR = bytes((0, 1, 3, 2))
BOX_ARM, BOX_ANGLE, BOX_FAILSAFE, BOX_OVERRIDE = 0, 1, 27, 50
"""Permanent ids of the modes (``msp_box.c``)."""
ARMING_DISABLED = (
    "no_gyro", "failsafe", "receiver_failsafe", "not_disarmed", "failsafe_switch",
    "runaway_takeoff", "crash_detected", "throttle_not_low", "not_level", "boot_grace_time",
    "no_prearm", "load", "calibrating", "cli", "cms_menu", "bst", "msp", "paralyze",
    "gps_rescue", "gps_rescue_switch", "dshot_telemetry", "reboot_required", "dshot_bitbang",
    "accelerometer_not_calibrated", "motor_protocol", "crash_flip", "altitude_hold",
    "position_hold", "autopilot", "arm_switch",
)  # fmt: skip
"""Why the board does not arm, by bit (``runtime_config.h``)."""
MAX_PULSE_US = 3000
COUNTS_DEG_S = 16.4
"""``RAW_IMU`` has counts of a gyro with a range of 2000 deg/s."""
FIX_AGE_MS = 200.0
"""From the measurement to the answer: the receiver at the board's UART, and the time between two
requests."""
_FAILSAFE_BITS = 1 << 1 | 1 << 2
_ATTITUDE, _RATES = struct.Struct("<3h"), struct.Struct("<6x3h")
_RC, _ANALOG, _GPS = struct.Struct("<6H"), struct.Struct("<7xH"), struct.Struct("<BB2iHHH")
_STATUS = struct.Struct("<6xI4xBB")
_FLAGS = struct.Struct("<BI")
_TUNING = struct.Struct("<5B6xBBB2x6xB")
_ANGLE_AT = 17
_SERVOS, _MOTOR = struct.Struct("<8H"), struct.Struct("<H")


class UnfitError(Exception):
    """Why set-points must not be sent to this board: the end of a sentence."""


@dataclass(frozen=True, slots=True)
class Status:
    """Active modes by permanent id, and the reasons against arming."""

    boxes: frozenset[int]
    arming_disabled: int

    @property
    def is_failsafe(self) -> bool:
        return BOX_FAILSAFE in self.boxes or bool(self.arming_disabled & _FAILSAFE_BITS)

    @property
    def reasons(self) -> list[str]:
        return [name for bit, name in enumerate(ARMING_DISABLED) if self.arming_disabled >> bit & 1]


def read_status(payload: bytes, box_ids: bytes) -> Status:
    """``box_ids`` is the answer to ``BOX_IDS``: bit n of the flags is its mode n."""
    low, _, more = _STATUS.unpack_from(payload)
    at = _STATUS.size
    flags = low | int.from_bytes(payload[at : at + (more & 15)], "little") << 32
    _, reasons = _FLAGS.unpack_from(payload, at + (more & 15))
    active = frozenset(each for bit, each in enumerate(box_ids) if flags >> bit & 1)
    return Status(active, reasons)


def read_attitude(payload: bytes) -> tuple[float, float, float]:
    """Return roll, pitch (nose up) and heading, deg."""
    roll, pitch, heading = _ATTITUDE.unpack_from(payload)
    return roll / 10, -pitch / 10, float(heading)


def read_rates(payload: bytes) -> tuple[float, float, float]:
    """Return the rates of roll, pitch (nose up) and yaw (to the right), deg/s."""
    roll, pitch, yaw = _RATES.unpack_from(payload)
    return roll / COUNTS_DEG_S, -pitch / COUNTS_DEG_S, -yaw / COUNTS_DEG_S


def read_channels(payload: bytes) -> tuple[int, int, int, int, int, int]:
    """Return ailerons, elevator (up: above 1500), throttle, rudder, aux1, aux2, us.

    The board sends ailerons, elevator, rudder, throttle, its elevator down above 1500.
    """
    ailerons, elevator, rudder, throttle, aux1, aux2 = _pulses(_RC.unpack_from(payload))
    return ailerons, 3000 - elevator, throttle, rudder, aux1, aux2


def read_voltage(payload: bytes) -> FlightBatteryCommand | None:
    """Return the voltage of the flight battery; None: not measured."""
    (hundredths,) = _ANALOG.unpack_from(payload)
    return FlightBatteryCommand.from_data({"voltage": hundredths / 100}) if hundredths else None


def read_fix(payload: bytes) -> LocationCommand | None:
    """Return the position; None without a fix. Raises WireError for values out of range."""
    has_fix, satellites, latitude, longitude, altitude, speed, course = _GPS.unpack_from(payload)
    if not has_fix:
        return None
    return LocationCommand.from_data(
        {
            "latitude": latitude / 1e7,
            "longitude": longitude / 1e7,
            "altitude": altitude,
            "speed": speed / 100,
            "bearing": course / 10,
            "age_ms": FIX_AGE_MS,
            "satellites": satellites,
        }
    )


def read_curves(settings: Mapping[int, bytes]) -> tuple[StickCurve, StickCurve]:
    """Return the curves of roll and pitch in ANGLE, from the answers to ``SETTINGS``.

    Raises UnfitError if set-points would not act as they are meant.
    """
    variant, version, receiver_map, tuning, deadband, advanced = map(settings.__getitem__, SETTINGS)
    if variant != b"BTFL":
        raise UnfitError("it is not Betaflight")
    if version[:2] < OLDEST_VERSION:
        raise UnfitError("before version 2026.6 it holds the last set-point when no other follows")
    if receiver_map[:4] != AETR:
        raise UnfitError("its channel map is not AETR")
    roll_rate, roll_expo, roll_max, pitch_max, _, _, pitch_rate, pitch_expo, kind = (
        _TUNING.unpack_from(tuning)
    )
    if kind != StickCurve.ACTUAL_RATES:
        raise UnfitError("its rates_type is not ACTUAL: its stick's curve is not known")
    limit_deg, dead_us = advanced[_ANGLE_AT], deadband[0]
    return (
        StickCurve(limit_deg, roll_rate, roll_max, roll_expo, dead_us),
        StickCurve(limit_deg, pitch_rate, pitch_max, pitch_expo, dead_us),
    )


def read_surfaces(payload: bytes) -> tuple[int, int, int]:
    """Return the servos of ailerons, elevator and rudder of the mixer AIRPLANE, us."""
    servos = _pulses(_SERVOS.unpack_from(payload))
    return servos[3], servos[6], servos[5]


def read_motor(payload: bytes) -> int:
    """Return the pulse of the first motor, us."""
    (motor,) = _pulses(_MOTOR.unpack_from(payload))
    return motor


def _pulses(values: tuple[int, ...]) -> tuple[int, ...]:
    if max(values) > MAX_PULSE_US:
        raise ValueError(f"pulses {values}")
    return values


def pack_sticks(sticks_us: Sequence[int]) -> bytes:
    """Return the payload of ``SET_RAW_RC``: ailerons, elevator, throttle, rudder, or the first two.

    The elevator of the board is down above 1500.
    """
    ailerons_us, elevator_us, *others = sticks_us
    values = (ailerons_us, 3000 - elevator_us, *others)
    return struct.pack(f"<{len(values)}H", *values)
