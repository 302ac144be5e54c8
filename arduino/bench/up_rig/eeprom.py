"""The chip's EEPROM from outside: preset it, read it, see whether it is being written."""

from __future__ import annotations

import ctypes

from up_rig.library import Handle

SIZE = 1024


class Eeprom:
    """1024 bytes that outlive power."""

    def __init__(self, library: ctypes.CDLL, handle: Handle) -> None:
        self._library = library
        self._handle = handle

    def read(self, start: int = 0, size: int = SIZE) -> bytes:
        cells = self._library.rig_eeprom(self._handle)
        return bytes(cells[start : min(start + size, SIZE)])

    def write(self, start: int, data: bytes) -> None:
        """Set its content, as a programmer would; raises ``ValueError`` beyond its end."""
        if start < 0 or start + len(data) > SIZE:
            raise ValueError(f"the EEPROM has {SIZE} bytes")
        cells = self._library.rig_eeprom(self._handle)
        for offset, value in enumerate(data):
            cells[start + offset] = value

    @property
    def writes(self) -> int:
        """Return how many bytes the program has written."""
        return int(self._library.rig_eeprom_writes(self._handle))

    @property
    def is_writing(self) -> bool:
        """Return whether a write is under way (3.4 ms a byte)."""
        return bool(self._library.rig_eeprom_is_writing(self._handle))
