"""The bytes of the serial line: checked framing as a firmware reads it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from up.protocols import checked_framing
from up.protocols.checked_framing import cobs_decode, crc16

MAX_PAYLOAD = 96
MAX_ENCODED = 101
FRAME_TIMEOUT_S = 0.1

COMMAND_SIZES = {
    "s": 0, "a": 0, "d": 0, "M": 1, "m": 0, "p": 3, "g": 72, "G": 0, "u": 10,
    "S": 10, "R": 10, "v": 1, "C": 54, "c": 0, "e": 1, "V": 2,
}  # fmt: skip
"""Payload bytes of every Command from the Raspberry Pi (protocols 2.3)."""


@dataclass(frozen=True, slots=True)
class Command:
    """A serial Command as received: its type letter, payload and, if framed, its sequence."""

    type: str
    payload: bytes
    sequence: int = 0


def checked_frame(sequence: int, type_letter: str, payload: bytes = b"") -> bytes:
    """Return one frame of checked framing with its end mark."""
    return checked_framing.checked_frame(sequence, ord(type_letter), payload)


def open_frame(encoded: bytes) -> bytes | None:
    """Return sequence, type and payload of a frame without its end mark; None for a bad one."""
    frame = cobs_decode(encoded) if len(encoded) <= MAX_ENCODED else None
    if frame is None or len(frame) < 4 or crc16(frame):
        return None
    return frame[:-2]


class CheckedReader:
    """Finds checked frames in a stream; counts the frames that it drops (``dropped``)."""

    def __init__(self) -> None:
        self._buffer = bytearray()
        self._first_s = 0.0
        self.dropped = 0

    def feed(self, data: bytes, now_s: float) -> Iterator[Command]:
        """Take bytes received at ``now_s`` and yield the Commands that they complete."""
        self.expire(now_s)
        for byte in data:
            if byte:
                if not self._buffer:
                    self._first_s = now_s
                if len(self._buffer) <= MAX_ENCODED:
                    self._buffer.append(byte)
            elif self._buffer:
                found = _command_of(bytes(self._buffer))
                self._buffer.clear()
                if found is None:
                    self.dropped += 1
                else:
                    yield found

    def expire(self, now_s: float) -> None:
        """Drop a frame that is unfinished 100 ms after its first byte."""
        if self._buffer and now_s - self._first_s >= FRAME_TIMEOUT_S:
            self._buffer.clear()
            self.dropped += 1


def _command_of(encoded: bytes) -> Command | None:
    body = open_frame(encoded)
    if body is None or COMMAND_SIZES.get(chr(body[1])) != len(body) - 2:
        return None
    return Command(chr(body[1]), body[2:], body[0])
