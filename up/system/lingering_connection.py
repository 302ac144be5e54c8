"""A connection that is closed without losing the answer."""

from typing import Any

from twisted.protocols.policies import ProtocolWrapper


class LingeringConnection(ProtocolWrapper):
    """Ends its output on `loseConnection` and discards input until the peer closes.

    A close while input is unread would reset the connection, and the peer would lose the answer.
    The owner bounds the time.
    """

    transport: Any
    disconnecting = False

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        if not self.disconnecting:
            super().dataReceived(data)  # type: ignore[no-untyped-call]

    def loseConnection(self) -> None:  # noqa: N802 - Twisted's name
        self.disconnecting = True
        self.transport.loseWriteConnection()
