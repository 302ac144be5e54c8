"""Connections that were refused and have a moment to read why."""

from up_proxy.connection import Connection

LEAVE_S = 2.0
"""A refused connection has this long to read why."""
LEAVE_BYTES = 1_000_000
"""Who sends more meanwhile does not read."""


class Leaving:
    """Owns refused connections: bears what they still send for a while, and lets them go."""

    def __init__(self) -> None:
        self._since_s: dict[Connection, float] = {}
        self._heard_bytes: dict[Connection, int] = {}

    def begin(self, connection: Connection, now_s: float) -> None:
        """Take a connection that was refused."""
        connection.owner = self
        connection.half = None
        self._since_s[connection] = now_s
        self._heard_bytes[connection] = 0

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Ignore them."""
        self._bear(connection, len(lines))

    def on_half_line(self, connection: Connection) -> None:
        """Ignore it."""
        half, connection.half = connection.half, None
        self._bear(connection, len(half or b""))

    def on_drained(self, connection: Connection) -> None:
        """Nothing follows."""

    def on_end(self, connection: Connection, reason: str) -> None:
        """Forget it."""
        self._since_s.pop(connection, None)
        self._heard_bytes.pop(connection, None)

    def sweep(self, now_s: float) -> None:
        """Close what has had its time."""
        for connection, since_s in self._since_s.items():
            if now_s - since_s >= LEAVE_S:
                connection.fail("refused")

    def _bear(self, connection: Connection, count: int) -> None:
        self._heard_bytes[connection] += count
        if self._heard_bytes[connection] > LEAVE_BYTES:
            connection.fail("refused")
