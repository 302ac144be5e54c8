"""The Arduino's status message, sent five times a second."""

from up.commands.board_schema import STATUS, SWITCH_POSITIONS, BoardStatus, Veto
from up.commands.board_status import TOPIC, reset_causes_of, vetoes_of
from up.commands.command import BaseCommand
from up.commands.roles import Role
from up.quick_dataclass import dataclass

RECEIVER_WAIT_S = 5
"""A receiver that lost power in the air is received again within this time."""


@dataclass(frozen=True, slots=True)
class ArduinoStatusCommand(BoardStatus, BaseCommand):
    """The status of the Arduino (docs/protocols.md 2.7)."""

    NAME = TOPIC
    ROLES = frozenset({Role.BOARD})

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
    def is_profile_valid(self) -> bool:
        """Return whether profile, gains and calibration of the EEPROM, if any, are valid."""
        return not self.vetoes & Veto.PROFILE_INVALID

    @property
    def veto_names(self) -> tuple[str, ...]:
        return tuple(vetoes_of(self.data))

    @property
    def reset_causes(self) -> str:
        """Return the cause of the Arduino's last start, in words."""
        return reset_causes_of(self.data)


def read_status(payload: bytes) -> ArduinoStatusCommand:
    """Return the status in the payload of `x`: fields of a newer firmware are ignored.

    Those that an older one lacks are 0. At least ``OLDEST_SIZE`` bytes.
    """
    return ArduinoStatusCommand(*STATUS.unpack(payload[: STATUS.size].ljust(STATUS.size, b"\0")))
