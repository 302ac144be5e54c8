"""Connections that have sent nothing, and still may."""

from typing import Protocol

from up_proxy.connection import Connection, Owner
from up_proxy.control import PREFIX


class Beginning(Owner, Protocol):
    """The owner that checks first lines."""

    def begin(self, connection: Connection) -> None:
        """Take a connection whose first line must be checked."""


class Silent:
    """Owns a connection that counts as a thesis client because it sent nothing.

    A hello that the network delayed past the time limit is still accepted if it is the first data
    of the connection.
    """

    def __init__(self, seated: Owner, opening: Beginning) -> None:
        self._seated = seated
        self._opening = opening

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Continue according to the first line."""
        if lines.startswith(PREFIX):
            self._seated.on_end(connection, "said hello late")
            self._opening.begin(connection)
            self._opening.on_lines(connection, lines)
        else:
            connection.owner = self._seated
            self._seated.on_lines(connection, lines)

    def on_half_line(self, connection: Connection) -> None:
        """Wait for the rest of the line."""

    def on_drained(self, connection: Connection) -> None:
        """Forward the call."""
        self._seated.on_drained(connection)

    def on_end(self, connection: Connection, reason: str) -> None:
        """Forward the call."""
        self._seated.on_end(connection, reason)
