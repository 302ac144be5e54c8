"""Monitors a board's serial line and keeps the newest datum of each kind."""

from __future__ import annotations

import struct

from up.commands.board_schema import STATUS, BoardStatus
from up.commands.orientation_command import OrientationCommand
from up_simulator.firmware.wire import CheckedReader, Command, checked_frame

SIZES = {
    "r": 8, "i": 13, "O": 26, "x": STATUS.size, "K": 2, "!": 3, "m": 1, "G": 72, "C": 54,
}  # fmt: skip
"""Payload bytes of every message from the Arduino in checked framing (protocols 2.4)."""
_ORIENTATION = struct.Struct(">H6f")


class LineMonitor:
    """Decodes the bytes that a board sends; each datum has the time at which it was complete.

    A datum that no longer arrives keeps its last value, and its ``_s`` shows the age.
    ``bad_frames`` counts the invalid ones. A frame cut by a reset is invalid.
    """

    def __init__(self) -> None:
        self._reader = CheckedReader(SIZES)
        self._sequence = 0
        self.status: BoardStatus | None = None
        self.status_s = -float("inf")
        self.orientation: OrientationCommand | None = None
        self.orientation_s = -float("inf")
        self.mode: str | None = None
        self.answers: list[Command] = []

    @property
    def bad_frames(self) -> int:
        counters = self._reader.counters
        return counters.crc_errors + counters.format_errors + counters.timeouts

    def feed(self, data: bytes, now_s: float) -> list[Command]:
        """Take bytes received until ``now_s``; return the messages that they complete."""
        found = self._reader.feed(data, now_s)
        for message in found:
            self._take(message, now_s)
        return found

    def command_bytes(self, type_letter: str, payload: bytes = b"") -> bytes:
        """Return the next Command to the board as bytes for its line (protocols 2.3)."""
        sequence, self._sequence = self._sequence, (self._sequence + 1) % 256
        return checked_frame(sequence, type_letter, payload)

    def start_bytes(self) -> bytes:
        """Return a Start Command: after it the board sends its streams."""
        return self.command_bytes("s")

    def take_answers(self) -> list[Command]:
        """Return the answers since the last call: ``K ! m T G C``."""
        answers, self.answers = self.answers, []
        return answers

    def _take(self, message: Command, now_s: float) -> None:
        payload = message.payload
        match message.type:
            case "x":
                self.status, self.status_s = BoardStatus(*STATUS.unpack(payload)), now_s
                self.mode = self.status.mode_letter
            case "O":
                sequence, yaw, pitch, roll, *rates = _ORIENTATION.unpack(payload)
                yaw_rate, pitch_rate, roll_rate = rates
                self.orientation = OrientationCommand(
                    roll, pitch, yaw, roll_rate, pitch_rate, yaw_rate, sequence
                )
                self.orientation_s = now_s
            case "r" | "i":
                pass
            case _:
                if message.type == "m":
                    self.mode = payload.decode("latin-1")
                self.answers.append(message)
