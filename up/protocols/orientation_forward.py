"""The Orientation Forward Protocol: frames of six floats from a sensor (docs/protocols.md 3)."""

from functools import lru_cache
from struct import Struct
from typing import NamedTuple

FRAME_SIZE = 24
LARGEST_ANGLE_DEG = 360.0
LARGEST_RATE_DEG_S = 4000.0

_FRAME = Struct(">6f")
_FRAMES_AT_ONCE = 128
_BLOCK_SIZE = FRAME_SIZE * _FRAMES_AT_ONCE
_MAGNITUDE = 0x7FFFFFFF
_ANGLE_SQUARED, _RATE_SQUARED = LARGEST_ANGLE_DEG**2, LARGEST_RATE_DEG_S**2
_unpack = _FRAME.unpack


OrientationValues = tuple[float, float, float, float, float, float]
"""The fields of an `OrientationFrame` in order, as a plain tuple."""


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
    """Return the one frame of a datagram; None for another size, or a value out of range."""
    if len(datagram) != FRAME_SIZE:
        return None
    values = _FRAME.unpack(datagram)
    return OrientationFrame(*values) if _is_in_range(values) else None


class OrientationDecoder:
    """Finds frames in the bytes of one connection; holds less than one frame.

    Returns plain tuples: naming the fields of a frame takes as long as decoding it, so the reader
    does it if needed (`OrientationFrame._make`).
    `dropped` counts frames with a value that is not finite or out of range.
    """

    def __init__(self) -> None:
        self.dropped = 0
        self._remainder = b""

    def feed(self, data: bytes) -> list[OrientationValues]:
        length = len(data)
        if length == FRAME_SIZE and not self._remainder:
            # The usual case, flat for speed: `_is_in_range` by squares, exact for 32-bit floats.
            values = a, b, c, d, e, f = _unpack(data)
            if (
                a * a <= _ANGLE_SQUARED
                and b * b <= _ANGLE_SQUARED
                and c * c <= _ANGLE_SQUARED
                and d * d <= _RATE_SQUARED
                and e * e <= _RATE_SQUARED
                and f * f <= _RATE_SQUARED
            ):
                return [values]
            self.dropped += 1
            return []
        if self._remainder:
            data = self._remainder + data
            length = len(data)
        excess = length % FRAME_SIZE
        self._remainder = data[length - excess :] if excess else b""
        if length <= _BLOCK_SIZE:
            return self._decode(data[: length - excess] if excess else data)
        frames: list[OrientationValues] = []
        for start in range(0, length - excess, _BLOCK_SIZE):
            frames += self._decode(data[start : min(start + _BLOCK_SIZE, length - excess)])
        return frames

    def _decode(self, block: bytes) -> list[OrientationValues]:
        count = len(block) // FRAME_SIZE
        if _are_all_in_range(block, count):
            return list(_FRAME.iter_unpack(block))
        good = [values for values in _FRAME.iter_unpack(block) if _is_in_range(values)]
        self.dropped += count - len(good)
        return good


def _is_in_range(values: tuple[float, ...]) -> bool:
    """Return whether all six are finite and within their limits; NaN compares as false."""
    roll, pitch, yaw, roll_rate, pitch_rate, yaw_rate = values
    return (
        -LARGEST_ANGLE_DEG <= roll <= LARGEST_ANGLE_DEG
        and -LARGEST_ANGLE_DEG <= pitch <= LARGEST_ANGLE_DEG
        and -LARGEST_ANGLE_DEG <= yaw <= LARGEST_ANGLE_DEG
        and -LARGEST_RATE_DEG_S <= roll_rate <= LARGEST_RATE_DEG_S
        and -LARGEST_RATE_DEG_S <= pitch_rate <= LARGEST_RATE_DEG_S
        and -LARGEST_RATE_DEG_S <= yaw_rate <= LARGEST_RATE_DEG_S
    )


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

    IEEE 754 magnitudes are ordered like the integers of their bits, infinity and NaN on top. So one
    addition over all frames carries into a sign bit wherever a magnitude exceeds its limit.
    """
    magnitude, addend, sign = _range_masks(count)
    return not ((int.from_bytes(block, "big") & magnitude) + addend) & sign
