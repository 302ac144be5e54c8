"""A link between real TCP sockets: its clients reach the target over the link."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.error import CannotListenError
from twisted.internet.protocol import ClientFactory, Factory, Protocol

from up.system.clock import Clock
from up_simulator.link.model import LinkModel
from up_simulator.link.relay_connection import RelayedConnection

LOOPBACK = "127.0.0.1"


class LinkRelayError(Exception):
    """The relay cannot listen: the message is one sentence for the user."""

    code = "port_in_use"


CONNECT_S = 30.0


class _ClientFactory(Factory):
    noisy = False

    def __init__(self, accept: Callable[[], Protocol]) -> None:
        self._accept = accept

    def buildProtocol(self, _address: Any) -> Protocol:  # noqa: N802
        return self._accept()


class LinkRelay:
    """Listens on a local port, and carries each connection to the target and back by two models.

    Port 0 is any free port; ``port`` has it after ``start``.

    ``up`` is the direction to the target, ``down`` the one back; all connections share them. The
    models' settings may change at any time. In a blackout nothing passes and neither end is
    notified: both stay open, and new connections are accepted and hang. Afterwards open
    connections continue as TCP's retransmissions do, and the peers of closed ones are closed.

    ``user_timeout_s`` closes a connection whose bytes have not arrived within that time, as
    TCP_USER_TIMEOUT does for a peer that has set it: the relay's own sockets hide the link from
    it.
    """

    def __init__(
        self,
        reactor: Any,
        listen_port: int,
        target_host: str,
        target_port: int,
        up: LinkModel,
        down: LinkModel,
        *,
        user_timeout_s: float | None = None,
    ) -> None:
        self._reactor = reactor
        self._listen_port = listen_port
        self._target = (target_host, target_port)
        self._listener: Any = None
        self.up = up
        self.down = down
        self.user_timeout_s = user_timeout_s
        self.clock: Clock = reactor
        self.connections: set[RelayedConnection] = set()
        self._idle: Deferred[None] | None = None

    @property
    def port(self) -> int:
        return self._listen_port if self._listener is None else self._listener.getHost().port

    def start(self) -> int:
        """Listen and return the port; raises ``LinkRelayError``."""
        factory = _ClientFactory(self._accept)
        try:
            self._listener = self._reactor.listenTCP(self._listen_port, factory, interface=LOOPBACK)
        except CannotListenError as error:
            where = f"{LOOPBACK}:{self._listen_port}"
            text = f"the link cannot listen on {where}: {error.socketError}"
            raise LinkRelayError(text) from error
        return self.port

    async def stop(self) -> None:
        listener, self._listener = self._listener, None
        if listener is not None:
            await listener.stopListening()
        for connection in list(self.connections):
            connection.abort()
        if self.connections:
            self._idle = Deferred()
            await self._idle

    def connect(self, factory: ClientFactory) -> Any:
        return self._reactor.connectTCP(*self._target, factory, timeout=CONNECT_S)

    def discard(self, connection: RelayedConnection) -> None:
        self.connections.discard(connection)
        if self._idle is not None and not self.connections:
            idle, self._idle = self._idle, None
            idle.callback(None)

    def _accept(self) -> Protocol:
        connection = RelayedConnection(self)
        self.connections.add(connection)
        return connection.near
