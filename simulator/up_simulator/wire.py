"""The bytes of the serial line: COBS, CRC, and the two framings as a firmware reads them."""

from __future__ import annotations

from binascii import crc_hqx
from collections.abc import Iterator
from dataclasses import dataclass

LONGEST_PAYLOAD = 96
LONGEST_ENCODED = 101
UNFINISHED_S = 0.1

COMMAND_SIZES = {
    "s": 0, "a": 0, "d": 0, "M": 1, "m": 0, "p": 3, "t": 48, "T": 0, "g": 72, "G": 0, "h": 2,
    "b": 2, "B": 2, "l": 8, "u": 10, "S": 10, "v": 1, "C": 54, "c": 0, "e": 1,
}  # fmt: skip
"""Payload bytes of every Command from the Raspberry Pi (protocols 2.3)."""

THESIS_TYPES = frozenset("ptThbBl")
"""What thesis framing knows of them."""


@dataclass(frozen=True, slots=True)
class Command:
    """A serial Command as it came: its type letter, payload and, if framed, its sequence."""

    type: str
    payload: bytes
    sequence: int = 0


@dataclass(frozen=True, slots=True)
class Odd:
    """A checked frame whose check is right but whose type or size is not: 1 or 2 of 2.5."""

    type: int
    sequence: int
    reason: int


def crc16(data: bytes) -> int:
    """Return CRC-16/CCITT-FALSE of ``data`` (0x29B1 for ``123456789``)."""
    # XMODEM's CRC is the same but for where it begins.
    return crc_hqx(data, 0xFFFF)


def cobs_encode(plain: bytes) -> bytes:
    """Return ``plain`` without zero bytes (Cheshire and Baker 1999), without an end mark."""
    encoded = bytearray()
    for block in plain.split(b"\0"):
        while len(block) >= 254:
            encoded += b"\xff" + block[:254]
            block = block[254:]
        encoded.append(len(block) + 1)
        encoded += block
    return bytes(encoded)


def cobs_decode(encoded: bytes) -> bytes | None:
    """Return what was encoded, or None when a code points beyond the end or a zero is inside."""
    plain = bytearray()
    at = 0
    while at < len(encoded):
        code = encoded[at]
        block = encoded[at + 1 : at + code]
        if code == 0 or len(block) != code - 1 or 0 in block:
            return None
        plain += block
        at += code
        if code != 255 and at < len(encoded):
            plain.append(0)
    return bytes(plain)


def checked_frame(sequence: int, type_letter: str, payload: bytes = b"") -> bytes:
    """Return one frame of checked framing with its end mark."""
    body = bytes((sequence, ord(type_letter))) + payload
    return cobs_encode(body + crc16(body).to_bytes(2, "big")) + b"\0"


class CheckedReader:
    """Finds checked frames in a stream; counts what it drops (``dropped``, ``missing``)."""

    def __init__(self) -> None:
        self._buffer = bytearray()
        self._first_s = 0.0
        self._is_skipping = False
        self._expected: int | None = None
        self.valid = 0
        self.dropped = 0
        self.missing = 0

    def feed(self, data: bytes, now_s: float) -> Iterator[Command | Odd]:
        """Take bytes that came at ``now_s`` and yield what they complete."""
        self.expire(now_s)
        for byte in data:
            if byte:
                if not self._buffer:
                    self._first_s = now_s
                if len(self._buffer) < LONGEST_ENCODED:
                    self._buffer.append(byte)
                else:
                    self._is_skipping = True
            elif self._buffer:
                found = None if self._is_skipping else self._open(bytes(self._buffer))
                self._forget()
                if found is None or isinstance(found, Odd):
                    self.dropped += 1
                if found is not None:
                    yield found

    def expire(self, now_s: float) -> None:
        """Drop a frame that is unfinished 100 ms after its first byte."""
        if self._buffer and now_s - self._first_s >= UNFINISHED_S:
            self._forget()
            self.dropped += 1

    def _forget(self) -> None:
        self._buffer.clear()
        self._is_skipping = False

    def _open(self, encoded: bytes) -> Command | Odd | None:
        frame = cobs_decode(encoded)
        if frame is None or len(frame) < 4:
            return None
        body, check = frame[:-2], int.from_bytes(frame[-2:], "big")
        if crc16(body) != check:
            return None
        sequence, type_code, payload = body[0], body[1], body[2:]
        # A frame whose check is right did arrive, whatever else is wrong with it.
        if self._expected is not None:
            self.missing += (sequence - self._expected) % 256
        self._expected = (sequence + 1) % 256
        size = COMMAND_SIZES.get(chr(type_code))
        if size is None:
            return Odd(type_code, sequence, reason=1)
        if len(payload) != size:
            return Odd(type_code, sequence, reason=2)
        self.valid += 1
        return Command(chr(type_code), payload, sequence)


class ThesisReader:
    """Finds bare Commands in a stream (thesis 3.1.2); unknown type bytes are dropped alone."""

    def __init__(self) -> None:
        self._buffer = bytearray()
        self._first_s = 0.0
        self.dropped = 0

    def feed(self, data: bytes, now_s: float) -> Iterator[Command | int]:
        """Take bytes that came at ``now_s``; yield Commands, and unknown type bytes as numbers."""
        self.expire(now_s)
        for byte in data:
            if not self._buffer:
                if chr(byte) not in THESIS_TYPES:
                    self.dropped += 1
                    yield byte
                    continue
                self._first_s = now_s
            self._buffer.append(byte)
            letter = chr(self._buffer[0])
            if len(self._buffer) == 1 + COMMAND_SIZES[letter]:
                payload = bytes(self._buffer[1:])
                self._buffer.clear()
                yield Command(letter, payload)

    def expire(self, now_s: float) -> bool:
        """Drop a Command that is unfinished after 100 ms; true when there was one."""
        if not self._buffer or now_s - self._first_s < UNFINISHED_S:
            return False
        self._buffer.clear()
        self.dropped += 1
        return True
