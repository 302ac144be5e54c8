"""Every connection to the server: counted, bounded, closed when it sends no request."""

from __future__ import annotations

from typing import Any, cast

from twisted.internet.protocol import connectionDone
from twisted.protocols.policies import ProtocolWrapper, WrappingFactory
from twisted.python.failure import Failure

from up.system.addresses import neighbourhood
from up.system.clock import cancel
from up.system.lingering_connection import LingeringConnection

WAITING_LIMIT = 128
"""Connections that are not a welcomed page's."""
PER_PEER_LIMIT = 48
"""The same, of one IPv4 address or one IPv6 /64 network."""
HEADER_S = 5.0
"""The first request is complete by then, however its bytes are spread."""
HTTP_LIMIT_S = 60.0
"""A connection that is not a page's link by then is closed, which bounds slow requests."""


class Connection(LingeringConnection):
    """One connection; its protocol is replaced when it becomes a WebSocket."""

    factory: Any
    peer = ""
    has_asked = False
    """Whether a complete request has arrived."""

    def makeConnection(self, transport: Any) -> None:  # noqa: N802 - Twisted's name
        self._http = self.wrappedProtocol
        self._timer = self.factory.reactor.callLater(HEADER_S, self._on_time_over)
        super().makeConnection(transport)  # type: ignore[no-untyped-call]

    def on_request(self) -> None:
        if not self.has_asked:
            self.has_asked = True
            self._timer.reset(HTTP_LIMIT_S - HEADER_S)

    def refuse(self, answer: bytes) -> None:
        """Send an answer and read nothing more."""
        self.transport.write(answer)
        self.loseConnection()

    def loseConnection(self) -> None:  # noqa: N802 - Twisted's name
        """Linger after a request; a WebSocket has its own closing handshake."""
        if self.wrappedProtocol is self._http:
            super().loseConnection()
        else:
            self.transport.loseConnection()

    def admit(self) -> None:
        """Exclude it from the limits: its page is welcomed."""
        self.factory.remove(self)

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        cancel(self._timer)
        self.factory.remove(self)
        super().connectionLost(reason)  # type: ignore[no-untyped-call]

    def _on_time_over(self) -> None:
        if self.wrappedProtocol is self._http:
            self.abortConnection()


class Connections(WrappingFactory):
    """Accepts every connection; at a limit an older one that is not a welcomed page's is closed.

    It is one of the address that has the most: the oldest without a complete request, otherwise the
    oldest. So a page gets in although a few other addresses have all the connections they may.
    """

    protocol = Connection
    noisy = False

    def __init__(self, reactor: Any, wrapped: Any) -> None:
        super().__init__(wrapped)  # type: ignore[no-untyped-call]
        self.reactor = reactor
        self._waiting: dict[str, dict[Connection, None]] = {}

    def buildProtocol(self, addr: Any) -> ProtocolWrapper:  # noqa: N802 - Twisted's name
        made: Any = super().buildProtocol(addr)
        made.peer = neighbourhood(addr.host)
        own = self._waiting.setdefault(made.peer, {})
        if len(own) >= PER_PEER_LIMIT:
            self._shed(own)
        elif sum(map(len, self._waiting.values())) >= WAITING_LIMIT:
            self._shed(max(self._waiting.values(), key=len))
        own[made] = None
        return cast("Connection", made)

    def remove(self, connection: Connection) -> None:
        own = self._waiting.get(connection.peer, {})
        own.pop(connection, None)
        if not own:
            self._waiting.pop(connection.peer, None)

    def _shed(self, crowd: dict[Connection, None]) -> None:
        leaving = min(crowd, key=lambda each: each.has_asked)
        del crowd[leaving]
        leaving.abortConnection()
