"""The request port: permitted clients, and their limits."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any, cast

from twisted.internet.defer import Deferred
from twisted.internet.protocol import ServerFactory
from twisted.logger import Logger

from up.log import Limited
from up.system.addresses import is_private, neighbourhood, plain
from up.system.clock import Clock
from up_runner.request import Request
from up_runner.request_connection import RequestConnection
from up_runner.response import Response

LOG_INTERVAL_S = 10.0
Handle = Callable[[Request], Deferred[Response]]


class RequestServer(ServerFactory):
    """Accepts clients within limits and passes their requests to `handle`.

    Rejects a public peer unless `accept_public`. `counts` has the rejections by reason.
    """

    noisy = False

    def __init__(
        self,
        clock: Clock,
        handle: Handle,
        encode: Callable[[Response, str], bytes],
        *,
        limit: int,
        address_limit: int,
        idle_s: float,
        accept_public: bool,
    ) -> None:
        self.clock = clock
        self.idle_s = idle_s
        self.encode = encode
        self.counts: Counter[str] = Counter()
        self.log = Logger(namespace="runner.requests")
        self._handle = handle
        self._limit = limit
        self._address_limit = address_limit
        self._accept_public = accept_public
        self._limited = Limited(cast(Any, clock), LOG_INTERVAL_S)
        self._connections: set[RequestConnection] = set()
        self._by_source: Counter[str] = Counter()

    def __len__(self) -> int:
        return len(self._connections)

    def buildProtocol(self, addr: Any) -> RequestConnection | None:  # noqa: N802
        """Return a connection for a peer, or None to reject it."""
        host = plain(addr.host)
        if not self._accept_public and not is_private(host):
            reason = "it is a public address; i_accept_plain: true in runner.yml permits it"
            self._reject("public_address", host, reason)
            return None
        source = neighbourhood(host)
        if self._by_source[source] >= self._address_limit:
            self._reject("address_limit", host, "it has too many connections")
            return None
        if len(self._connections) >= self._limit and not self._make_room():
            self._reject("connection_limit", host, "all connections are in use")
            return None
        connection = RequestConnection(self, host)
        connection.factory = self
        self._connections.add(connection)
        self._by_source[source] += 1
        return connection

    def handle(self, connection: RequestConnection, request: Request) -> Deferred[Response]:
        self._limited.log(
            self.log.info,
            "{host} requests {action} of {aircraft}",
            code="request",
            key=(connection.host, request.action, request.aircraft),
            host=connection.host,
            action=request.action,
            aircraft=request.aircraft,
        )
        return self._handle(request)

    def on_gone(self, connection: RequestConnection) -> None:
        if connection in self._connections:
            self._connections.discard(connection)
            source = neighbourhood(connection.host)
            self._by_source[source] -= 1
            if not self._by_source[source]:
                del self._by_source[source]

    def close(self) -> None:
        for connection in list(self._connections):
            connection.drop()
        self._limited.stop()

    def _make_room(self) -> bool:
        """Drop the connection with the longest silence, except those that wait for an answer."""
        silent = [each for each in self._connections if not each.busy]
        if not silent:
            return False
        oldest = min(silent, key=lambda each: each.last_rx_s)
        self.counts["displaced"] += 1
        self.on_gone(oldest)
        oldest.drop()
        return True

    def _reject(self, code: str, host: str, reason: str) -> None:
        self.counts[code] += 1
        self._limited.log(
            self.log.warn,
            "rejected {host}: {reason}",
            key=code,
            code=code,
            host=host,
            reason=reason,
        )
