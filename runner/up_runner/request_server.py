"""The request port: permitted clients, and their limits."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, cast

from twisted.internet.defer import Deferred, succeed
from twisted.internet.protocol import ServerFactory
from twisted.logger import Logger

from up.log import Limited
from up.protocols.aircraft_sessions import Key
from up.protocols.binary_line import HANDSHAKE
from up.protocols.envelope import EnvelopeError, place_of
from up.protocols.handshake import Refusal
from up.protocols.runner_session import to_line
from up.system.addresses import is_private, neighbourhood, plain
from up.system.clock import Clock
from up.system.figures import Figure
from up_runner.config import Connections
from up_runner.request import MalformedRequest, Request, parse
from up_runner.request_connection import RequestConnection
from up_runner.request_gate import OFF, UNPROTECTED, RequestGate, refusal_of
from up_runner.response import Problem, Response

LOG_INTERVAL_S = 10.0
Handle = Callable[[Request], Deferred[Response]]


class RequestServer(ServerFactory):
    """Accepts clients within limits and passes their requests to `handle`.

    `gate` decides about peers with public addresses and about requests without a key. `counts` has
    the rejections by reason.
    """

    noisy = False

    def __init__(
        self,
        clock: Clock,
        handle: Handle,
        encode: Callable[[Response, str], bytes],
        limits: Connections,
        gate: RequestGate,
    ) -> None:
        self.clock = clock
        self.limits = limits
        self.encode = encode
        self.counts: Counter[str] = Counter()
        self.log = Logger(namespace="runner.requests")
        self._handle = handle
        self._gate = gate
        self._limited = Limited(cast(Any, clock), LOG_INTERVAL_S)
        self._connections: set[RequestConnection] = set()
        self._by_source: Counter[str] = Counter()

    def __len__(self) -> int:
        return len(self._connections)

    def buildProtocol(self, addr: Any) -> RequestConnection | None:  # noqa: N802
        """Return a connection for a peer, or None to reject it."""
        host = plain(addr.host)
        if not is_private(host) and not self._gate.accepts_public:
            reason = (
                "it is a public address; a key ('up keys add') permits it, and so does"
                " i_accept_plain: true in runner.yml"
            )
            self._reject("public_address", host, reason)
            return None
        source = neighbourhood(host)
        if self._by_source[source] >= self.limits.address_limit:
            self._reject("address_limit", host, "it has too many connections")
            return None
        if len(self._connections) >= self.limits.limit and not self._make_room():
            self._reject("connection_limit", host, "all connections are in use")
            return None
        connection = RequestConnection(self, host)
        connection.factory = self
        self._connections.add(connection)
        self._by_source[source] += 1
        return connection

    def figures(self) -> Iterator[Figure]:
        yield Figure("up_runner_connections", "Open connections of the request port.", len(self))
        for reason, count in self.counts.items():
            text = "Rejected connections and requests, by reason."
            yield Figure("up_runner_rejected", text, count, {"reason": reason}, "counter")

    def handle(self, connection: RequestConnection, request: Request) -> Deferred[bytes]:
        host = connection.host
        if request.body:
            return self._handle_protected(connection, request.body)
        if self._gate.requires_key(host):
            return self._refuse(request.aircraft, UNPROTECTED, host).addCallback(self.encode, host)
        return self._carry_out(request, host).addCallback(self.encode, host)

    def _handle_protected(self, connection: RequestConnection, body: bytes) -> Deferred[bytes]:
        sessions, host = connection.sessions, connection.host
        ended = {each.number: refusal for each, refusal in sessions.replace_keys(self._gate.keys)}
        try:
            if self._gate.is_off:
                return self._refuse(None, OFF, host).addCallback(self.encode, host)
            if body[0] == HANDSHAKE:
                said, reply = sessions.answer(body)
            elif (number := place_of(body)[0]) in ended:
                said, reply = ended[number]
            else:
                session, payload = sessions.open(body)
                return self._answer(payload, session.key, host).addCallback(
                    lambda found: to_line(session.answers.seal(self.encode(found, host)[:-1]))
                )
        except EnvelopeError as fault:
            problem = Problem(fault.code, "the protected line is not accepted")
            return self._refuse(None, problem, host).addCallback(self.encode, host)
        if isinstance(said, Refusal):
            self._reject(said.code, host, f"its key {sessions.name_of(said)!r} is not accepted")
        return succeed(to_line(reply))

    def _answer(self, payload: bytes, key: Key, host: str) -> Deferred[Response]:
        try:
            request = parse(payload)
        except MalformedRequest as error:
            return self._refuse(None, Problem("malformed_request", str(error)), host)
        problem = refusal_of(key, request)
        if problem is not None:
            return self._refuse(request.aircraft, problem, host)
        return self._carry_out(replace(request, key=key.id.hex()), host, key.name)

    def _carry_out(self, request: Request, host: str, key: str = "") -> Deferred[Response]:
        self._limited.log(
            self.log.info,
            "{host} requests {action} of {aircraft}, key {device!r}",
            code="request",
            key=(host, request.action, request.aircraft, key),
            host=host,
            action=request.action,
            aircraft=request.aircraft,
            device=key,
        )
        return self._handle(request)

    def _refuse(self, aircraft: str | None, problem: Problem, host: str) -> Deferred[Response]:
        self._reject(problem.code, host, problem.text)
        return succeed(Response(aircraft, error=problem))

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
