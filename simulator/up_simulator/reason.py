"""Why the board refuses a Command (protocols 2.5)."""

from __future__ import annotations

from enum import IntEnum


class Reason(IntEnum):
    """The third byte of ``!`` in checked framing."""

    UNKNOWN_TYPE = 1
    WRONG_SIZE = 2
    OUT_OF_RANGE = 3
    ONLY_DISARMED = 4
    NOT_IN_THESIS_FRAMING = 5
    TOO_OLD = 6
    NOT_AUTO = 7
    THROTTLE_NOT_LOW = 8
    RECEIVER_INVALID = 9
    IMU_INVALID = 10
    VETO = 11
    NOT_STILL = 12


class RefusedError(Exception):
    """The board does not carry a Command out."""

    def __init__(self, reason: Reason) -> None:
        super().__init__(reason.name)
        self.reason = reason
