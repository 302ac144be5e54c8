"""Refused connections in their lingering close."""

from up_proxy.connection import Connection

LEAVE_S = 2.0
"""A refused connection has this long to read the reason."""
LEAVE_BYTES = 1_000_000
"""A peer that sends more than this in the meantime does not read."""


class Leaving:
    """Owns refused connections: discards their data for a while, then closes them."""

    def __init__(self) -> None:
        self._since_s: dict[Connection, float] = {}
        self._heard_bytes: dict[Connection, int] = {}

    def begin(self, connection: Connection, now_s: float) -> None:
        """Take a refused connection."""
        connection.owner = self
        connection.half = None
        self._since_s[connection] = now_s
        self._heard_bytes[connection] = 0

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Ignore the lines."""
        self._bear(connection, len(lines))

    def on_half_line(self, connection: Connection) -> None:
        """Ignore the partial line."""
        half, connection.half = connection.half, None
        self._bear(connection, len(half or b""))

    def on_drained(self, connection: Connection) -> None:
        """Do nothing: no data follow."""

    def on_end(self, connection: Connection, reason: str) -> None:
        """Remove it."""
        self._since_s.pop(connection, None)
        self._heard_bytes.pop(connection, None)

    def sweep(self, now_s: float) -> None:
        """Close the connections whose time is over."""
        for connection, since_s in self._since_s.items():
            if now_s - since_s >= LEAVE_S:
                connection.fail("refused")

    def _bear(self, connection: Connection, count: int) -> None:
        self._heard_bytes[connection] += count
        if self._heard_bytes[connection] > LEAVE_BYTES:
            connection.fail("refused")
