"""The Arduino's status message, sent five times a second."""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.protocols.board_words import RESET_CAUSES, SWITCH_POSITIONS, VETOES

STATUS = Struct(">6B7H")
VERSION = 1
"""The protocol version of the serial line that this program implements."""

RECEIVER_WAIT_S = 5
"""A receiver that lost power in the air is received again within this time."""

_ARMED, _AT_AUTO, _RECEIVER, _IMU, _FAILSAFE, _BIAS_STORED, _GAINS_STORED, _HEARD = (
    1 << bit for bit in range(8)
)
_PROFILE_INVALID = 1 << 6
_RESTORED = 1 << 7
_BYTE = 255
_U16 = 65535


@dataclass(frozen=True, slots=True)
class ArduinoStatusCommand(BaseCommand):
    """The status of the Arduino; docs/protocols.md 2.7 says what each field counts."""

    NAME: ClassVar[str] = "arduino.status"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.BOARD})
    version: int = value(minimum=0, maximum=_BYTE)
    mode: int = value(minimum=0, maximum=_BYTE)
    switch: int = value(minimum=0, maximum=_BYTE)
    flags: int = value(minimum=0, maximum=_BYTE)
    vetoes: int = value(minimum=0, maximum=_BYTE)
    reset_cause: int = value(minimum=0, maximum=_BYTE)
    loop_us: int = value(minimum=0, maximum=_U16, unit="us")
    late_us: int = value(minimum=0, maximum=_U16, unit="us")
    frame_errors: int = value(minimum=0, maximum=_U16)
    frames_lost: int = value(minimum=0, maximum=_U16)
    uptime_s: int = value(minimum=0, maximum=_U16, unit="s")
    rx_age_ms: int = value(minimum=0, maximum=_U16, unit="ms")
    imu_age_ms: int = value(minimum=0, maximum=_U16, unit="ms")

    @property
    def is_armed(self) -> bool:
        """Return whether the motor and the Raspberry Pi's authority are armed."""
        return bool(self.flags & _ARMED)

    @property
    def is_at_auto(self) -> bool:
        """Return whether the pilot's switch is at AUTO."""
        return bool(self.flags & _AT_AUTO)

    def is_in_flight(self, has_motor: bool | None) -> bool | None:
        """Return whether the aircraft may be in flight; None while its motor is unknown.

        Armed it may. Without a motor it also flies disarmed: it is not in flight only if the
        receiver has not been received since the start, at least ``RECEIVER_WAIT_S`` ago.
        """
        if self.is_armed:
            return True
        if has_motor is None:
            return None
        if has_motor:
            return False
        return self.switch in SWITCH_POSITIONS or self.uptime_s < RECEIVER_WAIT_S

    @property
    def is_receiver_valid(self) -> bool:
        """Return whether the pilot's receiver sends valid pulses."""
        return bool(self.flags & _RECEIVER)

    @property
    def is_imu_valid(self) -> bool:
        """Return whether the IMU gives valid samples, so that the Arduino can stabilise."""
        return bool(self.flags & _IMU)

    @property
    def is_bias_stored(self) -> bool:
        """Return whether the gyro bias is an old one from EEPROM: the board moved at start."""
        return bool(self.flags & _BIAS_STORED)

    @property
    def is_profile_valid(self) -> bool:
        """Return whether the EEPROM's profile of the airframe, if any, is valid."""
        return not self.vetoes & _PROFILE_INVALID

    @property
    def is_restored(self) -> bool:
        """Return whether the last reset was in flight, with the state restored."""
        return bool(self.reset_cause & _RESTORED)

    @property
    def is_failsafe(self) -> bool:
        """Return whether the receiver is lost and its failsafe acts."""
        return bool(self.flags & _FAILSAFE)

    @property
    def are_gains_stored(self) -> bool:
        """Return whether the EEPROM holds valid gains."""
        return bool(self.flags & _GAINS_STORED)

    @property
    def switch_position(self) -> str | None:
        """Return ``low``, ``middle`` or ``high``; None while unknown."""
        return SWITCH_POSITIONS.get(self.switch)

    @property
    def veto_names(self) -> tuple[str, ...]:
        """Return the reasons against arming, in words."""
        return tuple(name for bit, name in enumerate(VETOES) if self.vetoes >> bit & 1)

    @property
    def reset_causes(self) -> str:
        """Return the cause of the Arduino's last start, in words."""
        named = [name for bit, name in enumerate(RESET_CAUSES) if self.reset_cause >> bit & 1]
        if self.reset_cause & _RESTORED:
            named.append("state restored")
        return ", ".join(named) or "unknown"


def read_status(payload: bytes) -> ArduinoStatusCommand:
    """Return the status in the 20 bytes of `x`."""
    return ArduinoStatusCommand(*STATUS.unpack(payload))
