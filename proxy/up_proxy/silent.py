"""Connections that have said nothing, and may yet."""

from typing import Protocol

from up_proxy.connection import Connection, Owner
from up_proxy.control import PREFIX


class Beginning(Owner, Protocol):
    """The owner that judges first lines."""

    def begin(self, connection: Connection) -> None:
        """Take a connection whose first line is to be judged."""


class Silent:
    """Owns a connection that was taken for a thesis client because it said nothing.

    A hello that the network delayed past the silence is still heard: it is then the first thing
    that the connection says.
    """

    def __init__(self, seated: Owner, opening: Beginning) -> None:
        self._seated = seated
        self._opening = opening

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Go on as what the first line shows."""
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
        """Pass it on."""
        self._seated.on_drained(connection)

    def on_end(self, connection: Connection, reason: str) -> None:
        """Pass it on."""
        self._seated.on_end(connection, reason)
