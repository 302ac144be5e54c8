"""The checksum of a stretch of a file that is read window by window."""

from __future__ import annotations

from zlib import crc32


class Checksum:
    """A CRC over the file from one place on; ``end`` is how far it has come."""

    def __init__(self, begin: int) -> None:
        self.value = 0
        self.begin = begin
        self.end = begin

    def take(self, buffer: bytes, base: int, until: int) -> None:
        """Go on to that byte of the file; ``buffer`` has what is missing, from ``base`` on."""
        if until > self.end:
            self.value = crc32(memoryview(buffer)[self.end - base : until - base], self.value)
            self.end = until
