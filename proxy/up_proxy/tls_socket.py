"""TLS on an accepted, non-blocking socket, with the calls of a socket that a connection uses."""

import socket
import ssl
from contextlib import suppress

_RECORD_BYTES = 16384


class TLSSocket:
    """One record at a time, so that an unsent record can be repeated exactly.

    After a `send` that would block, ``attempted`` bytes are encrypted already: the next `send`
    must begin with the same ones.
    """

    __slots__ = ("_socket", "attempted", "fileno", "name", "serial", "setsockopt")

    def __init__(self, connected: ssl.SSLSocket, name: str, serial: bytes) -> None:
        self._socket = connected
        self.fileno = connected.fileno
        self.setsockopt = connected.setsockopt
        self.attempted = 0
        self.name = name
        self.serial = serial

    def recv(self, size: int) -> bytes:
        try:
            return self._socket.recv(size)
        except ssl.SSLWantReadError:
            raise BlockingIOError from None

    def send(self, data: bytes) -> int:
        try:
            sent = self._socket.send(data[: self.attempted or _RECORD_BYTES])
        except ssl.SSLWantWriteError:
            self.attempted = self.attempted or min(len(data), _RECORD_BYTES)
            raise BlockingIOError from None
        self.attempted = 0
        return sent

    def shutdown(self, how: int) -> None:
        """Tell the peer that nothing follows; raises OSError."""
        with suppress(ssl.SSLError, ValueError):
            self._socket.unwrap()
        socket.socket.shutdown(self._socket, how)

    def close(self) -> None:
        self._socket.close()
