"""Lingering close of refused connections."""

from up_proxy.connection import Connection, Owner

LINGER_S = 2.0
"""A refused connection has this long to read the reason."""
LINGER_BYTES = 1_000_000
"""A peer that sends more than this while it lingers is closed immediately."""


class LingeringClose(Owner):
    """Owns refused connections: discards their data for a while, then closes them."""

    def __init__(self) -> None:
        self._since_s: dict[Connection, float] = {}
        self._rx_bytes: dict[Connection, int] = {}

    def begin(self, connection: Connection, now_s: float) -> None:
        connection.owner = self
        connection.partial = None
        self._since_s[connection] = now_s
        self._rx_bytes[connection] = 0

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        self._discard(connection, len(lines))

    def on_partial_line(self, connection: Connection) -> None:
        partial, connection.partial = connection.partial, None
        self._discard(connection, len(partial or b""))

    def on_end(self, connection: Connection, reason: str) -> None:
        self._since_s.pop(connection, None)
        self._rx_bytes.pop(connection, None)

    def sweep(self, now_s: float) -> None:
        for connection, since_s in self._since_s.items():
            if now_s - since_s >= LINGER_S:
                connection.fail("refused")

    def _discard(self, connection: Connection, count: int) -> None:
        self._rx_bytes[connection] += count
        if self._rx_bytes[connection] > LINGER_BYTES:
            connection.fail("refused")
