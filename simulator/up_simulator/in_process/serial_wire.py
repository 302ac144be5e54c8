"""The wire between board and Raspberry Pi, and what can be wrong with it."""

from __future__ import annotations

import random
import socket
from contextlib import suppress
from dataclasses import dataclass
from typing import Protocol


class SerialLine(Protocol):
    """The board's end of a serial line, as ``up_rig.pty_line.PtyLine``."""

    def read(self, timeout_s: float, most: int) -> bytes:
        """Return what has come, up to ``most`` bytes, waiting for it up to a time."""

    def write(self, data: bytes) -> None:
        """Send bytes, or drop them where nobody reads."""


@dataclass(frozen=True, slots=True)
class SerialNoise:
    """How often a byte is spoilt: each a probability from 0 to 1; raises ValueError for others."""

    flips: float = 0.0
    """One bit of the byte is turned."""
    inserts: float = 0.0
    """A byte comes that nobody sent, before this one."""
    drops: float = 0.0
    """The byte is lost."""

    def __post_init__(self) -> None:
        for name in ("flips", "inserts", "drops"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name} is a probability from 0 to 1, not {getattr(self, name)}")


class SerialWire:
    """A serial line with noise in both directions, and whose contacts may be loose.

    It is a ``SerialLine`` over another one. While ``is_connected`` is false both ends are
    silent and neither is told. The same seed and bytes give the same faults. ``noise`` may change
    at any time; ``spoilt`` counts bytes that it touched.
    """

    def __init__(self, line: SerialLine, seed: int = 1, noise: SerialNoise | None = None) -> None:
        self.noise = noise or SerialNoise()
        self.is_connected = True
        self.spoilt = 0
        self._line = line
        self._random = random.Random(seed)

    def read(self, timeout_s: float, most: int) -> bytes:
        """Return what has come to the board."""
        data = self._line.read(timeout_s, most)
        return self._pass(data) if data else data

    def write(self, data: bytes) -> None:
        """Send what comes from the board."""
        passed = self._pass(data) if data else data
        if passed:
            self._line.write(passed)

    def _pass(self, data: bytes) -> bytes:
        noise = self.noise
        if not self.is_connected:
            return b""
        if not (noise.flips or noise.inserts or noise.drops):
            return data
        draw = self._random.random
        passed = bytearray()
        for byte in data:
            if draw() < noise.inserts:
                self.spoilt += 1
                passed.append(self._random.randrange(256))
            if draw() < noise.drops:
                self.spoilt += 1
                continue
            if draw() < noise.flips:
                self.spoilt += 1
                byte ^= 1 << self._random.randrange(8)
            passed.append(byte)
        return bytes(passed)


class SocketLine:
    """The board's end of a line in this process; ``open`` gives the other end.

    Bytes pass at once and in order, without the system's own time as on a pty. Opening it again
    hangs up on the end before. ``unplug`` takes the whole adapter away: the port is gone.
    """

    def __init__(self) -> None:
        self.is_plugged = True
        self._own: socket.socket | None = None
        self._other: socket.socket | None = None

    def open(self) -> socket.socket:
        """Return the other end, which whoever asked has to close."""
        self.hang_up()
        self._own, self._other = socket.socketpair()
        self._own.setblocking(False)
        return self._other

    def read(self, timeout_s: float, most: int) -> bytes:
        """Return what has come; nothing is waited for."""
        if self._own is None:
            return b""
        try:
            return self._own.recv(most)
        except BlockingIOError:
            return b""
        except OSError:
            self.hang_up()
            return b""

    def write(self, data: bytes) -> None:
        """Send bytes; what nobody reads is dropped."""
        if self._own is not None:
            with suppress(OSError):
                self._own.send(data)

    def plug(self) -> None:
        """Let the port be there again."""
        self.is_plugged = True

    def unplug(self) -> None:
        """Take the port away: whoever has it open is hung up on."""
        self.is_plugged = False
        self.hang_up()

    def cut(self) -> None:
        """Close both ends, as when the program with the other one is killed."""
        self.hang_up()
        if self._other is not None:
            self._other.close()
            self._other = None

    def hang_up(self) -> None:
        """Close this end; bytes that have not passed are lost."""
        if self._own is not None:
            self._own.close()
            self._own = None
