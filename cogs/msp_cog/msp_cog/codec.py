"""The frames of MSP version 1: ``$M``, direction, size, type, payload, checksum."""

from functools import reduce
from operator import xor

from up.quick_dataclass import dataclass

REQUEST, REPLY, ERROR = b"$M<", b"$M>", b"$M!"
_HEADER = 5
MAX_PAYLOAD = 254
"""255 announces a longer frame of another format, which this cog neither requests nor sends."""


@dataclass(slots=True)
class MspCounters:
    """Counts of frames and of dropped bytes."""

    frames: int = 0
    refused: int = 0
    bad_checksums: int = 0
    dropped_bytes: int = 0


def encode(number: int, payload: bytes = b"", head: bytes = REQUEST) -> bytes:
    """Return a frame, by default a request; ValueError for a payload of more than 254 bytes."""
    if len(payload) > MAX_PAYLOAD:
        raise ValueError(f"a payload of {len(payload)} bytes, more than {MAX_PAYLOAD}")
    body = bytes((len(payload), number)) + payload
    return head + body + bytes((reduce(xor, body),))


class MspDecoder:
    """Finds replies, or what ``heads`` names, in a stream; other bytes are dropped and counted."""

    def __init__(self, heads: tuple[bytes, ...] = (REPLY, ERROR)) -> None:
        self.counters = MspCounters()
        self._heads = heads
        self._buffer = b""

    def reset(self) -> None:
        self._buffer = b""

    def feed(self, data: bytes) -> list[tuple[int, bytes]]:
        """Return type and payload of each whole frame; a refused request gives none."""
        buffer, at = self._buffer + data, 0
        found: list[tuple[int, bytes]] = []
        counters = self.counters
        while True:
            start = buffer.find(b"$", at)
            if start < 0:
                start = len(buffer)
            counters.dropped_bytes += start - at
            at = start
            head = buffer[at : at + 3]
            if len(head) == 3 and head not in self._heads:
                at += 1
                counters.dropped_bytes += 1
                continue
            end = at + _HEADER + 1 + (buffer[at + 3] if len(buffer) > at + 3 else 0)
            if len(buffer) < end or len(buffer) <= at + 3:
                break
            body = buffer[at + 3 : end - 1]
            if reduce(xor, body) != buffer[end - 1]:
                # The size may be wrong too: the next frame may begin inside.
                counters.bad_checksums += 1
                at += 1
                counters.dropped_bytes += 1
                continue
            at = end
            if head == ERROR:
                counters.refused += 1
            else:
                counters.frames += 1
                found.append((body[1], body[2:]))
        self._buffer = buffer[at:]
        return found
