"""The serial line between board and Raspberry Pi, as a socket in this process."""

from __future__ import annotations

import socket
from contextlib import suppress


class SocketLine:
    """The board's end of a line in this process; ``open`` gives the other end.

    Bytes pass in order and without the delays of a pty. A second ``open`` hangs up on the end
    before. ``unplug`` removes the whole adapter: the port is gone.
    """

    def __init__(self) -> None:
        self.is_plugged = True
        self._end: socket.socket | None = None
        self._peer: socket.socket | None = None

    def open(self) -> socket.socket:
        """Return the other end, which the caller has to close."""
        self.hang_up()
        self._end, self._peer = socket.socketpair()
        self._end.setblocking(False)
        return self._peer

    def read(self, timeout_s: float, max_bytes: int) -> bytes:
        if self._end is None:
            return b""
        try:
            return self._end.recv(max_bytes)
        except BlockingIOError:
            return b""
        except OSError:
            self.hang_up()
            return b""

    def write(self, data: bytes) -> None:
        """Send bytes; without a reader they are dropped."""
        if self._end is not None:
            with suppress(OSError):
                self._end.send(data)

    def plug(self) -> None:
        self.is_plugged = True

    def unplug(self) -> None:
        """Remove the port: an open end is hung up."""
        self.is_plugged = False
        self.hang_up()

    def cut(self) -> None:
        """Close both ends, as when the program with the other one is killed."""
        self.hang_up()
        if self._peer is not None:
            self._peer.close()
            self._peer = None

    def hang_up(self) -> None:
        """Close this end; bytes that have not passed are lost."""
        if self._end is not None:
            self._end.close()
            self._end = None
