"""Consistent Overhead Byte Stuffing (Cheshire and Baker 1999), without the closing zero."""

from __future__ import annotations

_LONGEST_RUN = 254


class CobsError(ValueError):
    """The bytes are not valid COBS: a zero inside, or a code that points beyond the end."""


def encode(plain: bytes) -> bytes:
    """Return `plain` without zero bytes; one byte longer, and one more for each full run."""
    encoded = bytearray()
    for run in plain.split(b"\0"):
        start = 0
        while len(run) - start >= _LONGEST_RUN:
            encoded.append(0xFF)
            encoded += run[start : start + _LONGEST_RUN]
            start += _LONGEST_RUN
        encoded.append(len(run) - start + 1)
        encoded += run[start:]
    return bytes(encoded)


def decode(encoded: bytes) -> bytes:
    """Return the plain bytes; raises `CobsError`. Empty input decodes to nothing."""
    plain = bytearray()
    position = 0
    end = len(encoded)
    while position < end:
        code = encoded[position]
        following = position + code
        if code == 0 or following > end:
            raise CobsError("a COBS code points beyond the end" if code else "a zero inside COBS")
        run = encoded[position + 1 : following]
        if 0 in run:
            raise CobsError("a zero inside COBS")
        plain += run
        position = following
        if code != 0xFF and position < end:
            plain.append(0)
    return bytes(plain)
