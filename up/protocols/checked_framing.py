"""Checked framing of the serial line: COBS, sequence and CRC16 (docs/protocols.md 2.1)."""

from binascii import crc_hqx
from collections.abc import Mapping
from types import MappingProxyType

from up.protocols.frame import MAX_PAYLOAD, UNFINISHED_TIMEOUT_S, Frame, FrameCounters

INITIAL_CRC = 0xFFFF

MAX_ENCODED = 101
"""Bytes of the longest frame without its closing zero."""

_MIN_ENCODED = 5


def _states_before() -> tuple[int, ...]:
    """Return for each byte the CRC state that this byte turns into the initial one."""
    zero = next(state for state in range(0x10000) if crc_hqx(b"\0", state) == INITIAL_CRC)
    return tuple(zero ^ (byte << 8) for byte in range(256))


# The first COBS code precedes the sequence. A CRC that starts in the state which this code turns
# into the initial one avoids a copy to cut it off.
_STATE_BEFORE = _states_before()


def crc16(data: bytes | bytearray) -> int:
    """Return the CRC-16/CCITT-FALSE: polynomial 0x1021, initial 0xFFFF, not reflected.

    A message followed by its own CRC, high byte first, has the CRC 0.
    """
    return crc_hqx(data, INITIAL_CRC)


def cobs_encode(plain: bytes) -> bytes:
    """Return up to 253 bytes without zeros (Cheshire and Baker 1999), without the closing zero."""
    encoded = bytearray()
    for run in plain.split(b"\0"):
        encoded.append(len(run) + 1)
        encoded += run
    return bytes(encoded)


def cobs_decode(encoded: bytes) -> bytes | None:
    """Return the plain bytes of up to 254 encoded ones; None for invalid COBS."""
    plain = bytearray(encoded)
    position = 0
    while position < len(encoded) and encoded[position]:
        plain[position] = 0
        position += encoded[position]
    if position != len(encoded) or 0 in encoded:
        return None
    return bytes(plain[1:])


def checked_frame(sequence: int, type_: int, payload: bytes = b"") -> bytes:
    """Return one frame with its closing zero."""
    body = bytes((sequence, type_)) + payload
    return cobs_encode(body + crc_hqx(body, INITIAL_CRC).to_bytes(2, "big")) + b"\0"


class CheckedEncoder:
    """Builds checked frames with the sequence of one direction."""

    opening = b"\0"

    def __init__(self) -> None:
        self.last_sequence = 255

    def encode(self, type_: int, payload: bytes = b"") -> bytes:
        """Return one frame with its closing zero; ValueError for more than 96 bytes."""
        if len(payload) > MAX_PAYLOAD:
            raise ValueError(f"a payload of {len(payload)} bytes, at most {MAX_PAYLOAD} fit")
        self.last_sequence = sequence = (self.last_sequence + 1) & 0xFF
        return checked_frame(sequence, type_, payload)


class CheckedDecoder:
    """Finds checked frames in a stream of bytes.

    Holds at most one unfinished frame and drops a longer one while receiving it. A frame with a
    valid CRC counts for the sequence even if its type is unknown: it did arrive.
    """

    def __init__(
        self, sizes: Mapping[int, int], least: Mapping[int, int] = MappingProxyType({})
    ) -> None:
        self.counters = FrameCounters()
        self._sizes = dict(sizes)
        self._least = dict(least)
        self._tail = b""
        self._is_skipping = False
        self._expected_sequence = -1
        self._newest_byte_s = 0.0

    def feed(self, data: bytes, now: float = 0.0) -> list[Frame]:
        if self._tail or self._is_skipping:
            self.expire(now)
        self._newest_byte_s = now
        if not data:
            return []
        pieces = (self._tail + data).split(b"\0")
        tail = pieces.pop()
        if self._is_skipping and pieces:
            self._is_skipping = False
            pieces[0] = b""
        if self._is_skipping:
            tail = b""
        elif len(tail) > MAX_ENCODED:
            self.counters.format_errors += 1
            self._is_skipping = True
            tail = b""
        self._tail = tail
        return self._decode(pieces) if pieces else []

    def expire(self, now: float) -> list[Frame]:
        """Drop a frame whose newest byte is 100 ms old; silence completes none."""
        if now >= self._newest_byte_s + UNFINISHED_TIMEOUT_S:
            if self._tail:
                self.counters.timeouts += 1
            self._tail = b""
            self._is_skipping = False
        return []

    def reset(self) -> None:
        """Discard the unfinished frame and the sequence: the line was reopened."""
        self._tail = b""
        self._is_skipping = False
        self._expected_sequence = -1

    def _decode(self, pieces: list[bytes]) -> list[Frame]:
        """Return the valid frames among `pieces`; written flat because it is the hot path."""
        counters = self.counters
        size_of = self._sizes.get
        state_before = _STATE_BEFORE
        expected = self._expected_sequence
        frames: list[Frame] = []
        for piece in pieces:
            length = len(piece)
            if not _MIN_ENCODED <= length <= MAX_ENCODED:
                if length:
                    counters.format_errors += 1
                continue
            # Below 255 bytes every code replaces a zero: put the zeros back.
            position = piece[0]
            if position != length:
                patched = bytearray(piece)
                while position < length:
                    patched[position] = 0
                    position += piece[position]
                if position != length:
                    counters.format_errors += 1
                    continue
                piece = bytes(patched)
            if crc_hqx(piece, state_before[piece[0]]):
                counters.crc_errors += 1
                continue
            sequence = piece[1]
            if sequence != expected and expected >= 0:
                counters.lost_by_sequence += (sequence - expected) & 0xFF
            expected = (sequence + 1) & 0xFF
            type_ = piece[2]
            size = size_of(type_)
            if size is None:
                counters.unknown_types += 1
            elif size != length - _MIN_ENCODED and (
                length - _MIN_ENCODED < self._least.get(type_, MAX_ENCODED)
            ):
                counters.format_errors += 1
            else:
                frames.append((type_, piece[3:-2], sequence))
        self._expected_sequence = expected
        counters.frames += len(frames)
        return frames
