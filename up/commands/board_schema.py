"""Codes and fields of the board's status. Generated from schema/status.yml by tools/schema.py; do not edit."""
# ruff: noqa: D101, E501, RUF100
# fmt: off

from __future__ import annotations

from enum import IntEnum, IntFlag
from struct import Struct

from up.commands.command import value
from up.commands.schema_rows import Datum
from up.quick_dataclass import dataclass

VERSION = 1
STATUS = Struct('>BBBBBBHHHHHHHHB')
OLDEST_SIZE = 20
FLIGHT_MODES = {'a': 'ACRO', 'r': 'RATE', 'f': 'FBW', 's': 'SETPOINT', 'R': 'RETURN', 'u': 'OUTPUT', 'h': 'RTH'}
MODE_TEXTS = {'ACRO': 'the sticks move the surfaces', 'RATE': 'the sticks ask for rotation', 'FBW': 'the sticks ask for attitude, within limits', 'SETPOINT': 'the Raspberry Pi sets the attitude', 'RETURN': 'the Raspberry Pi sets the attitude in receiver failsafe', 'OUTPUT': 'the Raspberry Pi sets the servo positions', 'RTH': 'return home, sent by old firmware; without behaviour'}
PI_MODES = ('SETPOINT', 'RETURN', 'OUTPUT')
SWITCH_MODES = {'a': 'ACRO', 'r': 'RATE', 'f': 'FBW', 'A': 'AUTO'}
SWITCH_POSITIONS = {0: 'low', 1: 'middle', 2: 'high'}
VETOES = ('the throttle is not low', 'the receiver is invalid', 'the IMU is invalid', 'AUX2 is low', 'the Raspberry Pi vetoes', 'calibrating', 'the profile is invalid', 'a veto that this program does not know')
RESET_CAUSES = {0: 'power-on', 1: 'external', 2: 'brown-out', 3: 'watchdog', 7: 'state restored'}
REASONS = {1: 'unknown type', 2: 'wrong size', 3: 'out of range', 4: 'only on the ground, not in flight', 6: 'too old', 7: 'the switch is not at AUTO', 8: 'the throttle is not low', 9: 'the receiver is invalid', 10: 'the IMU is invalid', 11: 'a veto', 12: 'not still enough', 14: 'the profile does not allow it', 15: "the receiver's failsafe does not act", 16: "pin A7 has no battery's voltage: check the divider"}


class Reason(IntEnum):
    UNKNOWN_TYPE = 1
    WRONG_SIZE = 2
    OUT_OF_RANGE = 3
    ONLY_ON_GROUND = 4
    TOO_OLD = 6
    NOT_AT_AUTO = 7
    THROTTLE_NOT_LOW = 8
    RECEIVER_INVALID = 9
    IMU_INVALID = 10
    VETO = 11
    NOT_STILL = 12
    NOT_ALLOWED = 14
    NOT_IN_FAILSAFE = 15
    BATTERY_NOT_MEASURED = 16


class Veto(IntFlag):
    THROTTLE_NOT_LOW = 1
    RECEIVER_INVALID = 2
    IMU_INVALID = 4
    AUX2_LOW = 8
    RASPBERRY_PI = 16
    CALIBRATING = 32
    PROFILE_INVALID = 64
    UNKNOWN = 128


class Reset(IntFlag):
    POWER_ON = 1
    EXTERNAL = 2
    BROWN_OUT = 4
    WATCHDOG = 8
    RESTORED = 128


class Flag(IntFlag):
    ARMED = 1
    AT_AUTO = 2
    RECEIVER_VALID = 4
    IMU_VALID = 8
    FAILSAFE = 16
    BIAS_STORED = 32
    GAINS_STORED = 64
    PI_RECEIVED = 128


DATA = (
    Datum('version', 'version', None, 'number', '', "version of this page's serial section", False, ''),
    Datum('mode', 'mode', None, 'number', '', 'flight mode letter', False, ''),
    Datum('switch', 'switch', None, 'text', '', 'AUX1 position', True, ''),
    Datum('flags', 'flags', None, 'text', '', 'flags', False, ''),
    Datum('armed', 'flags', 0, 'flag', '', 'the motor and the Raspberry Pi may act', False, 'armed'),
    Datum('at_auto', 'flags', 1, 'flag', '', 'the mode switch is at AUTO', False, 'auto'),
    Datum('receiver_valid', 'flags', 2, 'flag', '', 'the receiver is valid', True, 'receiver_valid'),
    Datum('imu_valid', 'flags', 3, 'flag', '', 'the attitude is valid', True, 'imu_valid'),
    Datum('failsafe', 'flags', 4, 'flag', '', "the receiver's failsafe acts", True, 'failsafe'),
    Datum('bias_stored', 'flags', 5, 'flag', '', "the gyro's bias is from EEPROM", True, ''),
    Datum('gains_stored', 'flags', 6, 'flag', '', 'EEPROM holds valid gains', False, 'gains_valid'),
    Datum('pi_received', 'flags', 7, 'flag', '', 'the Raspberry Pi was received within 1 s', False, 'pi_heard'),
    Datum('vetoes', 'vetoes', None, 'text', '', 'reasons against arming', False, ''),
    Datum('throttle_not_low', 'vetoes', 0, 'flag', '', '', False, ''),
    Datum('receiver_invalid', 'vetoes', 1, 'flag', '', '', False, ''),
    Datum('imu_invalid', 'vetoes', 2, 'flag', '', '', False, ''),
    Datum('aux2_low', 'vetoes', 3, 'flag', '', '', False, ''),
    Datum('raspberry_pi', 'vetoes', 4, 'flag', '', '', False, ''),
    Datum('calibrating', 'vetoes', 5, 'flag', '', '', False, ''),
    Datum('profile_invalid', 'vetoes', 6, 'flag', '', 'profile, gains or calibration of EEPROM cannot be read', False, ''),
    Datum('unknown', 'vetoes', 7, 'flag', '', '', False, ''),
    Datum('reset_cause', 'reset_cause', None, 'text', '', 'cause of the last reset', True, ''),
    Datum('power_on', 'reset_cause', 0, 'flag', '', '', False, ''),
    Datum('external', 'reset_cause', 1, 'flag', '', '', False, ''),
    Datum('brown_out', 'reset_cause', 2, 'flag', '', '', False, ''),
    Datum('watchdog', 'reset_cause', 3, 'flag', '', '', False, ''),
    Datum('restored', 'reset_cause', 7, 'flag', '', 'the last reset was in flight and the state before it was restored', True, 'restored'),
    Datum('loop_us', 'loop_us', None, 'number', 'us', 'loop period, mean of the last second', True, 'loop_us'),
    Datum('late_us', 'late_us', None, 'number', 'us', 'greatest lateness of the loop in the last second', True, 'loop_late_us'),
    Datum('frame_errors', 'frame_errors', None, 'number', '', 'dropped frames since reset, stays at 65535', True, 'dropped_frames'),
    Datum('frames_lost', 'frames_lost', None, 'number', '', 'frames missing by sequence, stays at 65535', False, 'missing_frames'),
    Datum('uptime_s', 'uptime_s', None, 'number', 's', 'time since reset, stays at 65535', False, 'uptime_s'),
    Datum('rx_age_ms', 'rx_age_ms', None, 'number', 'ms', "age of the receiver's newest pulses, stays at 65535 (age_ms.rx is that of the message)", False, 'receiver_age_ms'),
    Datum('imu_age_ms', 'imu_age_ms', None, 'number', 'ms', "age of the IMU's newest sample, stays at 65535", False, 'imu_age_ms'),
    Datum('battery_mv', 'battery_mv', None, 'number', 'mV', "voltage of the flight battery at A7; 0: no divider, not calibrated, or beyond the pin's 1.1 V", False, 'battery_mv'),
    Datum('acceleration', 'acceleration', None, 'number', '', 'change of the airspeed as the accelerometer feels it: 128 and the acceleration forward in 1/64 g, mean of 128 ms in each 286 ms; 0: unknown', False, ''),
)


@dataclass(frozen=True, slots=True)
class BoardStatus:
    """The fields of the status message, in the order of the wire."""

    version: int = value(minimum=0, maximum=255, unit='')
    mode: int = value(minimum=0, maximum=255, unit='')
    switch: int = value(minimum=0, maximum=255, unit='')
    flags: int = value(minimum=0, maximum=255, unit='')
    vetoes: int = value(minimum=0, maximum=255, unit='')
    reset_cause: int = value(minimum=0, maximum=255, unit='')
    loop_us: int = value(minimum=0, maximum=65535, unit='us')
    late_us: int = value(minimum=0, maximum=65535, unit='us')
    frame_errors: int = value(minimum=0, maximum=65535, unit='')
    frames_lost: int = value(minimum=0, maximum=65535, unit='')
    uptime_s: int = value(minimum=0, maximum=65535, unit='s')
    rx_age_ms: int = value(minimum=0, maximum=65535, unit='ms')
    imu_age_ms: int = value(minimum=0, maximum=65535, unit='ms')
    battery_mv: int = value(minimum=0, maximum=65535, unit='mV')
    acceleration: int = value(minimum=0, maximum=255, unit='')

    @property
    def mode_letter(self) -> str:
        """Return the letter of the flight mode."""
        return chr(self.mode)

    @property
    def is_armed(self) -> bool:
        """Return whether the motor and the Raspberry Pi may act."""
        return bool(self.flags & 1)

    @property
    def is_at_auto(self) -> bool:
        """Return whether the mode switch is at AUTO."""
        return bool(self.flags & 2)

    @property
    def is_receiver_valid(self) -> bool:
        """Return whether the receiver is valid."""
        return bool(self.flags & 4)

    @property
    def is_imu_valid(self) -> bool:
        """Return whether the attitude is valid."""
        return bool(self.flags & 8)

    @property
    def is_failsafe(self) -> bool:
        """Return whether the receiver's failsafe acts."""
        return bool(self.flags & 16)

    @property
    def is_bias_stored(self) -> bool:
        """Return whether the gyro's bias is from EEPROM."""
        return bool(self.flags & 32)

    @property
    def is_gains_stored(self) -> bool:
        """Return whether EEPROM holds valid gains."""
        return bool(self.flags & 64)

    @property
    def is_pi_received(self) -> bool:
        """Return whether the Raspberry Pi was received within 1 s."""
        return bool(self.flags & 128)

    @property
    def is_restored(self) -> bool:
        """Return whether the last reset was in flight and the state before it was restored."""
        return bool(self.reset_cause & 128)
