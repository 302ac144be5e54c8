"""Packed telemetry: a frame as raw deflate with an earlier frame as its dictionary.

A body is the type byte, three bytes and the deflate data. The three bytes, big-endian, are the
number of the dictionary, and in their highest bit whether this frame is a key: the dictionary of
later ones. A number is the low 23 bits of the CRC-32 of the dictionary, so that a key that is not
the sender's is never taken for it. Keys are packed against the previous key, after `restart`
against `DICTIONARY`, which every reader has; all other frames can be left out. In place of deflate
data there may be an attitude frame.
"""

import math
import zlib
from collections.abc import Callable
from typing import Any

from up.protocols.attitude_frame import Expander, is_attitude, shorten
from up.protocols.binary_line import PACKED
from up.protocols.line_decoder import MAX_LINE_BYTES
from up.protocols.packed_dictionary import DICTIONARY

KEY_AGE_S = 0.3
"""A frame that is sent when the key is older becomes the next key."""
RENEWAL = 1.7
"""So does a frame with this many times the data of the smallest one since the key."""
_WINDOW_BITS = -13
_KEY_FLAG = 1 << 23
_HEAD_BYTES = 4

IsEnough = Callable[[dict[str, Any], dict[str, Any]], bool]
"""Whether the content of an attitude frame may stand for that of a frame."""


class PackedError(ValueError):
    """Not a packed frame, or too large."""


class UnknownKeyError(PackedError):
    """A frame whose dictionary was not received here."""


def number_of(key: bytes) -> int:
    """Return the number by which frames name their dictionary."""
    return zlib.crc32(key) & (_KEY_FLAG - 1)


class Packer:
    """Packs the frames of one connection; each result must be sent, in order."""

    def __init__(self) -> None:
        self._key = DICTIONARY
        self._key_s: float | None = None
        self._least: float = math.inf

    def restart(self) -> None:
        """Make the next frame a key that every reader can unpack."""
        self._key = DICTIONARY
        self._key_s = None

    def pack(
        self, frame: bytes, now_s: float, whole_s: float = 0.0, is_enough: IsEnough | None = None
    ) -> bytes:
        """Return the body of a frame that leaves now.

        With `is_enough` every whole frame is a key, and attitude frames may stand for those of the
        next `whole_s`.
        """
        if is_enough is not None and self._key_s is not None and now_s - self._key_s < whole_s:
            short = shorten(self._key, frame)
            if short is not None and is_enough(*short[1:]):
                return self._head(0) + short[0]
        coder = zlib.compressobj(6, zlib.DEFLATED, _WINDOW_BITS, 8, 0, self._key)
        data = coder.compress(frame) + coder.flush()
        is_due = self._key_s is None or now_s - self._key_s >= KEY_AGE_S
        is_key = is_due or is_enough is not None or len(data) > RENEWAL * self._least
        head = self._head(_KEY_FLAG if is_key else 0)
        self._least = math.inf if is_key else min(self._least, len(data))
        if is_key:
            self._key, self._key_s = frame, now_s
        return head + data

    def _head(self, flag: int) -> bytes:
        return bytes((PACKED,)) + (number_of(self._key) | flag).to_bytes(3, "big")


class Unpacker:
    """Unpacks the frames of one aircraft; keeps the newest key alone."""

    def __init__(self) -> None:
        self._keys = {number_of(DICTIONARY): DICTIONARY}
        self._expander = Expander(DICTIONARY)

    def unpack(self, body: bytes) -> bytes:
        """Return the frame of a body, at most 16 KiB; raises PackedError."""
        if len(body) <= _HEAD_BYTES or body[0] != PACKED:
            raise PackedError("not a packed frame")
        number = int.from_bytes(body[1:_HEAD_BYTES], "big")
        key = self._keys.get(number & ~_KEY_FLAG)
        if key is None:
            raise UnknownKeyError("the key of this frame was not received")
        if is_attitude(body):
            if self._expander.key is not key:
                self._expander = Expander(key)
            try:
                return self._expander.expand(body[_HEAD_BYTES:])
            except ValueError as fault:
                raise PackedError(str(fault)) from None
        decoder = zlib.decompressobj(_WINDOW_BITS, key)
        try:
            frame = decoder.decompress(body[_HEAD_BYTES:], MAX_LINE_BYTES)
        except zlib.error:
            raise PackedError("not deflate data") from None
        if not decoder.eof or decoder.unused_data or len(frame) >= MAX_LINE_BYTES:
            raise PackedError("too large, cut off or continued")
        if number & _KEY_FLAG:
            self._keys = {number_of(DICTIONARY): DICTIONARY, number_of(frame): frame}
        return frame
