"""The serial line: bytes to the chip at the line's rate, bytes from it with their times."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

from up_rig.library import Handle


@dataclass(frozen=True, slots=True)
class SentByte:
    """A byte from the chip, with the cycle at which its stop bit ended."""

    cycle: int
    value: int


class Serial:
    """The Raspberry Pi's end of the line: one wire each way, 8N1, 115200 Bd unless changed."""

    def __init__(self, library: ctypes.CDLL, handle: Handle) -> None:
        self._library = library
        self._handle = handle

    def set_baud(self, baud: float) -> None:
        self._library.rig_uart_baud(self._handle, baud)

    def write(self, data: bytes, *, broken: bool = False) -> None:
        """Put bytes on the line, each when the one before has ended.

        ``broken`` corrupts their stop bits, so that the chip sees framing errors.
        """
        self._library.rig_uart_write(self._handle, data, len(data), int(broken))

    @property
    def waiting(self) -> int:
        """Return how many bytes the chip has still to get."""
        return int(self._library.rig_uart_waiting(self._handle))

    @property
    def overruns(self) -> int:
        """Return the number of bytes that arrived when the chip's receiver was full."""
        return int(self._library.rig_overruns(self._handle))

    def read(self) -> bytes:
        return bytes(each.value for each in self.read_stamped())

    def read_stamped(self) -> list[SentByte]:
        """Return the bytes received since the last call, with their times."""
        count = ctypes.c_uint64()
        sent = self._library.rig_sent(self._handle, ctypes.byref(count))
        fresh = [SentByte(sent[at].cycle, sent[at].value) for at in range(count.value)]
        self._library.rig_clear_sent(self._handle)
        return fresh
