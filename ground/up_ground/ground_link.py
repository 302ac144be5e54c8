"""The link to the aircraft: connects, reconnects, keeps the seat."""

from __future__ import annotations

from typing import Any
from typing import Protocol as Interface

from twisted.application.internet import ClientService
from twisted.internet.defer import Deferred
from twisted.internet.endpoints import HostnameEndpoint
from twisted.internet.error import ConnectionRefusedError, TimeoutError
from twisted.internet.interfaces import IProtocolFactory, IStreamClientEndpoint
from twisted.internet.protocol import Factory
from twisted.python.failure import Failure
from zope.interface import implementer

from up.protocols.binary_line import HANDSHAKE, PACKED, PROTECTED, SHORT, to_body
from up.protocols.general_message import GeneralMessage, decode
from up.protocols.packed_telemetry import UnknownKeyError, Unpacker
from up.protocols.pairing import Pairing
from up.protocols.proxy_lines import (
    Accepted,
    Access,
    AircraftPresence,
    ControlGive,
    ControlGranted,
    ControlLost,
    ControlOwner,
    ControlRelease,
    ControlRequest,
    ControlRequested,
    GroundLine,
    Hello,
    KeyRequest,
    ProxyLine,
    Refused,
    parse_line,
)
from up.system.backoff import Backoff
from up.tls.errors import TLSError
from up.tls.files import TLSFiles
from up.tls.protocol import TLSClientEndpoint
from up_ground.ground_protocol import GroundProtocol
from up_ground.link_security import LinkSecurity
from up_ground.link_status import LinkState, LinkStatus
from up_ground.settings import Seat, Settings
from up_ground.token_store import TokenStore

CONNECT_TIMEOUT_S = 5.0
_PACKED = bytes((PACKED,))
KEY_INTERVAL_S = 0.5
"""Minimum time between two requests for a key."""


class LinkListener(Interface):
    """Who uses the link."""

    def on_message(self, message: GeneralMessage) -> None: ...

    def on_link(self) -> None: ...


@implementer(IStreamClientEndpoint)
class GroundLink:
    """Reconnects after each loss until it is stopped, and takes its seat back.

    ``status`` is always up to date; a lost connection leaves no partial lines behind.
    """

    def __init__(
        self,
        reactor: Any,
        settings: Settings,
        listener: LinkListener,
        tokens: TokenStore,
        backoff: Backoff | None = None,
    ) -> None:
        self.status = LinkStatus(since_s=reactor.seconds())
        self._reactor = reactor
        self._settings = settings
        self._tls = None if settings.tls is None else TLSFiles(settings.tls)
        self._listener = listener
        self._tokens = tokens
        self._wanted = settings.seat
        self._token: str | None = None
        self._backoff = backoff or Backoff()
        self._connection: GroundProtocol | None = None
        self._too_long = 0
        self._is_greeted = False
        self._unpacker = Unpacker()
        self._key_asked_s = -KEY_INTERVAL_S
        pairing = settings.pairing
        self._security = None if pairing is None else LinkSecurity(reactor, pairing, self.status)
        factory: Any = Factory.forProtocol(self._build)
        factory.noisy = False
        make: Any = ClientService
        self._service = make(
            self, factory, retryPolicy=lambda _: self._backoff.pause_s(), clock=reactor
        )

    def start(self) -> None:
        if self._wanted is Seat.COMMAND and not self._settings.direct:
            self._tokens.hold()
            self._token = self._tokens.load()
        self._service.startService()

    async def stop(self) -> None:
        """Close the link permanently; returns when the connection is closed."""
        self.status.disconnected(LinkState.STOPPED, self._reactor.seconds())
        if self._connection is not None:
            self._connection.close()
        await self._service.stopService()
        self._tokens.close()

    def send(self, line: bytes) -> bool:
        """Send an encoded message; return False without a connection, or without its session."""
        if self._security is None:
            return self._send(line)
        sealed = self._security.seal(line)
        return sealed is not None and self._send(sealed)

    def _send(self, line: bytes) -> bool:
        connection = self._connection
        return self.status.is_open and connection is not None and connection.send(line)

    def request_seat(self) -> bool:
        """Request the seat; a free one is granted immediately. Return False if not sent."""
        self._wanted = Seat.COMMAND
        self._tokens.hold()
        return not self._settings.direct and self._send(ControlRequest().encode())

    def give_seat(self, to: int) -> bool:
        return self.status.seat is Seat.COMMAND and self._send(ControlGive(to).encode())

    def release_seat(self) -> bool:
        return self.status.seat is Seat.COMMAND and self._send(ControlRelease().encode())

    def reconnect(self, seat: Seat) -> None:
        """Repeat the hello for another seat: an aircraft's own listener grants it only that way."""
        self._wanted = seat
        if seat is Seat.COMMAND:
            self._tokens.hold()
        else:
            self._token = None
            self._tokens.forget()
        self._backoff.reset()
        if self._connection is not None:
            self._connection.abort("reconnecting to request control", "reconnect")

    def pair(self, pairing: Pairing) -> None:
        """Use another key; the session of the one before ends."""
        if self._security is not None:
            self._security.stop()
        self.status.key_refusal = ""
        self._security = LinkSecurity(self._reactor, pairing, self.status)
        if self.status.is_open:
            self._security.start(self._send)
        self._listener.on_link()

    def measure(self) -> None:
        if self._connection is not None and self.status.is_open:
            self.status.round_trip_ms = self._connection.round_trip_ms()

    def on_made(self, connection: GroundProtocol) -> None:
        """Wait for the answer to the hello; without a hello start immediately."""
        self._connection = connection
        self._is_greeted = self._settings.direct
        if self._settings.direct:
            self._opened()
            self._listener.on_link()

    def on_line(self, connection: GroundProtocol, line: bytes) -> None:
        """Take a relayed line: a General Message, or something to drop and count."""
        if not self._is_greeted:
            connection.abort(
                "the other side does not answer a hello: not a Ground Station Proxy of this"
                " version (--direct sends no hello)",
                "no_proxy",
            )
            return
        self.status.too_long = self._too_long + connection.dropped_too_long
        try:
            body = self._open(line)
            if body is None:
                return
            if body[:1] == _PACKED:
                body = self._unpacker.unpack(body)
            message = decode(body)
        except UnknownKeyError:
            self.status.keyless += 1
            self._request_key(connection)
            return
        except ValueError:
            self.status.malformed += 1
            return
        self._listener.on_message(message)

    def _open(self, line: bytes) -> bytes | None:
        """Return the body of a line, as far as this device may take it; raises ValueError."""
        if self._security is not None:
            return self._security.open(line)
        if line[0] in (PROTECTED, HANDSHAKE, SHORT):
            self.status.unprotected += 1
            return None
        return to_body(line)

    def _request_key(self, connection: GroundProtocol) -> None:
        now_s = self._reactor.seconds()
        if now_s - self._key_asked_s >= KEY_INTERVAL_S:
            self._key_asked_s = now_s
            connection.send(KeyRequest().encode())

    def on_control(self, connection: GroundProtocol, line: bytes) -> None:
        said = None if self._settings.direct else parse_line(line)
        is_due = isinstance(said, Refused) or isinstance(said, Accepted) is not self._is_greeted
        if said is None or isinstance(said, GroundLine) or not is_due:
            self.status.strange_control += 1
            return
        self._obey(connection, said)
        self._listener.on_link()

    def on_lost(self, connection: GroundProtocol, reason: str, code: str) -> None:
        self._too_long += connection.dropped_too_long
        self.status.too_long = self._too_long
        self._connection = None
        if self._security is not None:
            self._security.stop()
        self._on_no_link(reason, code)

    def connect(self, protocolFactory: IProtocolFactory) -> Deferred[Any]:  # noqa: N803
        """Make one attempt; the service calls it as its endpoint."""
        self.status.state = LinkState.CONNECTING
        host = self._settings.host
        endpoint: Any = HostnameEndpoint(
            self._reactor, host, self._settings.port, timeout=CONNECT_TIMEOUT_S
        )
        if self._tls is not None:
            endpoint = TLSClientEndpoint(self._reactor, endpoint, self._tls, host)
        connecting: Deferred[Any] = endpoint.connect(protocolFactory)
        return connecting.addErrback(self._on_failed)

    def _obey(self, connection: GroundProtocol, said: ProxyLine) -> None:
        status = self.status
        if isinstance(said, Accepted):
            self._is_greeted = True
            connection.accept()
            self._opened()
            status.seat = Seat.COMMAND if said.access is Access.COMMAND else Seat.LISTEN
            if status.seat is Seat.COMMAND:
                self._keep(said.token)
        elif isinstance(said, Refused):
            status.rejection = said.code
            connection.abort(f"the proxy refuses: {said.reason} ({said.code})", "rejected")
        elif isinstance(said, ControlGranted):
            status.seat = self._wanted = Seat.COMMAND
            self._tokens.hold()
            self._keep(said.token)
        elif isinstance(said, ControlLost):
            status.seat = self._wanted = Seat.LISTEN
            status.asked_by = self._token = None
            self._tokens.forget()
        elif isinstance(said, ControlRequested):
            status.asked_by = said.by
        elif isinstance(said, ControlOwner):
            status.holder = said.number
            status.is_holder_known = True
        elif isinstance(said, AircraftPresence):
            status.is_aircraft_online = said.is_online
            if said.is_online and self._security is not None:
                self._security.renew()

    def _keep(self, token: str) -> None:
        self._token = token
        self._tokens.save(token)

    def _opened(self) -> None:
        status = self.status
        status.disconnected(LinkState.OPEN, self._reactor.seconds())
        status.rejection = ""
        status.failures = 0
        status.connections += 1
        if self._tls is not None and self._connection is not None:
            status.tls_peer = self._connection.transport.peer_name
        self._backoff.reset()
        if self._security is not None:
            self._security.start(self._send)

    def _build(self) -> GroundProtocol:
        hello = None
        if not self._settings.direct:
            token = self._token if self._wanted is Seat.COMMAND else None
            hello = Hello(
                self._settings.aircraft,
                Access(self._wanted.value),
                token,
                packed=True,
                attitude=True,
            ).encode()
        return GroundProtocol(self._reactor, self, hello)

    def _on_failed(self, failure: Failure) -> Failure:
        code = failure.value.code if isinstance(failure.value, TLSError) else "unreachable"
        self._on_no_link(f"cannot reach {self._settings.address}: {_why(failure)}", code)
        return failure

    def _on_no_link(self, reason: str, code: str) -> None:
        if self.status.state is not LinkState.STOPPED:
            self.status.disconnected(LinkState.WAITING, self._reactor.seconds(), reason, code)
            self.status.failures += 1
            self._listener.on_link()


def _why(failure: Failure) -> str:
    if failure.check(ConnectionRefusedError):
        return "connection refused"
    if failure.check(TimeoutError):
        return f"no answer within {CONNECT_TIMEOUT_S:g} s"
    return str(failure.getErrorMessage()).rstrip(".")
