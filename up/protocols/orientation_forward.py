"""The Orientation Forward Protocol: six floats a frame, from the phone (docs/protocols.md 3)."""

from __future__ import annotations

from functools import lru_cache
from itertools import repeat
from struct import Struct
from typing import NamedTuple

FRAME_SIZE = 24
LARGEST_ANGLE_DEG = 360.0
LARGEST_RATE_DEG_S = 4000.0

_FRAME = Struct(">6f")
_FRAMES_AT_ONCE = 128
_MAGNITUDE = 0x7FFFFFFF


class OrientationFrame(NamedTuple):
    """One orientation: degrees, and degrees per second."""

    roll_deg: float
    pitch_deg: float
    yaw_deg: float
    roll_rate_deg_s: float
    pitch_rate_deg_s: float
    yaw_rate_deg_s: float


def encode(frame: OrientationFrame) -> bytes:
    """Return the 24 bytes of one frame."""
    return _FRAME.pack(*frame)


def decode_datagram(datagram: bytes) -> OrientationFrame | None:
    """Return the one frame of a datagram; None: another size, or a value out of range."""
    if len(datagram) != FRAME_SIZE or not _are_all_in_range(datagram, 1):
        return None
    return OrientationFrame(*_FRAME.unpack(datagram))


class OrientationDecoder:
    """Finds frames in the bytes of one connection; holds less than one frame.

    `dropped` counts frames with a value that is not finite or out of range.
    """

    def __init__(self) -> None:
        self.dropped = 0
        self._remainder = b""

    def feed(self, data: bytes) -> list[OrientationFrame]:
        """Return the frames that `data` completes, in order."""
        if self._remainder:
            data = self._remainder + data
        length = len(data)
        whole = length - length % FRAME_SIZE
        self._remainder = data[whole:]
        if whole == length and length <= FRAME_SIZE * _FRAMES_AT_ONCE:
            return self._decode(data)
        frames: list[OrientationFrame] = []
        for start in range(0, whole, FRAME_SIZE * _FRAMES_AT_ONCE):
            frames += self._decode(data[start : min(start + FRAME_SIZE * _FRAMES_AT_ONCE, whole)])
        return frames

    def _decode(self, block: bytes) -> list[OrientationFrame]:
        count = len(block) // FRAME_SIZE
        if _are_all_in_range(block, count):
            # What OrientationFrame._make does, without a Python call for each frame.
            return list(map(tuple.__new__, repeat(OrientationFrame), _FRAME.iter_unpack(block)))
        good = [
            frame
            for start in range(0, len(block), FRAME_SIZE)
            if (frame := decode_datagram(block[start : start + FRAME_SIZE])) is not None
        ]
        self.dropped += count - len(good)
        return good


@lru_cache(maxsize=_FRAMES_AT_ONCE + 1)
def _range_masks(count: int) -> tuple[int, int, int]:
    """Return magnitude mask, addend and sign mask for `count` frames as one long number."""
    angle = _MAGNITUDE - int.from_bytes(Struct(">f").pack(LARGEST_ANGLE_DEG), "big")
    rate = _MAGNITUDE - int.from_bytes(Struct(">f").pack(LARGEST_RATE_DEG_S), "big")

    def lanes(*values: int) -> int:
        return int.from_bytes(b"".join(value.to_bytes(4, "big") for value in values) * count, "big")

    return (
        lanes(*[_MAGNITUDE] * 6),
        lanes(*[angle] * 3, *[rate] * 3),
        lanes(*[_MAGNITUDE + 1] * 6),
    )


def _are_all_in_range(block: bytes, count: int) -> bool:
    """Return whether every float is finite and within its limit.

    IEEE 754 magnitudes are ordered like the integers of their bits, infinity and NaN on top. So
    one addition over all frames carries into a sign bit wherever a magnitude passes its limit.
    """
    magnitude, addend, sign = _range_masks(count)
    return not ((int.from_bytes(block, "big") & magnitude) + addend) & sign
