"""Every connection to the server: counted, bounded, cut off when it says nothing."""

from __future__ import annotations

from collections import Counter
from typing import Any

from twisted.internet.interfaces import IAddress
from twisted.internet.protocol import connectionDone
from twisted.protocols.policies import ProtocolWrapper, WrappingFactory
from twisted.python.failure import Failure

CONNECTIONS_LIMIT = 128
PER_PEER_LIMIT = 48
HTTP_LIMIT_S = 60.0
"""A connection that has not become a page's link by then is closed: nobody dribbles for ever."""


class Connection(ProtocolWrapper):
    """One connection; what it carries is replaced when it becomes a WebSocket."""

    transport: Any
    factory: Any

    def makeConnection(self, transport: Any) -> None:  # noqa: N802 - Twisted's name
        """Begin to count and to wait."""
        self._http = self.wrappedProtocol
        reactor = self.factory.reactor
        self._timer = reactor.callLater(HTTP_LIMIT_S, self._on_time_over)
        super().makeConnection(transport)  # type: ignore[no-untyped-call]

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        """Stop counting."""
        if self._timer.active():
            self._timer.cancel()
        self.factory.peers[_host(self.transport.getPeer())] -= 1
        super().connectionLost(reason)  # type: ignore[no-untyped-call]

    def _on_time_over(self) -> None:
        if self.wrappedProtocol is self._http:
            self.abortConnection()


class Connections(WrappingFactory):
    """Refuses connections beyond the limits, all told and from one address."""

    protocol = Connection
    noisy = False

    def __init__(self, reactor: Any, wrapped: Any) -> None:
        super().__init__(wrapped)  # type: ignore[no-untyped-call]
        self.reactor = reactor
        self.peers: Counter[str] = Counter()

    def buildProtocol(  # type: ignore[override]  # noqa: N802
        self, addr: IAddress | None
    ) -> ProtocolWrapper | None:
        """Return what carries the connection; None closes it."""
        peers = self.peers = +self.peers
        host = _host(addr)
        if peers.total() >= CONNECTIONS_LIMIT or peers[host] >= PER_PEER_LIMIT:
            return None
        peers[host] += 1
        made: ProtocolWrapper | None = super().buildProtocol(addr)
        return made


def _host(address: Any) -> str:
    return str(getattr(address, "host", ""))
