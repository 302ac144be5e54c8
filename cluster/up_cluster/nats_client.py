"""A NATS client on Twisted's reactor: it connects to one of several servers and stays connected."""

import itertools
import secrets
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from twisted.application.internet import ClientService
from twisted.internet.abstract import isIPAddress, isIPv6Address
from twisted.internet.defer import CancelledError, Deferred
from twisted.internet.endpoints import HostnameEndpoint, TCP4ClientEndpoint, TCP6ClientEndpoint
from twisted.internet.error import ConnectionDone
from twisted.internet.protocol import Factory, Protocol, connectionDone
from twisted.python.failure import Failure

from up.log import Limited, UpLogger
from up.system.backoff import Backoff
from up.system.clock import Clock, Timer, cancel
from up.tls.files import TLSFiles
from up.tls.protocol import TLSClientEndpoint
from up.version import VERSION
from up_cluster import nats_protocol as nats
from up_cluster.config import Server
from up_cluster.errors import UnavailableError

CONNECT_LIMIT_S = 2.0
PING_S = 0.5
"""Time between two PINGs; a server that sends nothing for SILENCE_S is left."""
SILENCE_S = 2.0
MAX_WAITING_BYTES = 2**20
"""Data that wait for a slow server; beyond it the oldest are dropped."""
REQUEST_LIMIT_S = 2.0
LOG_INTERVAL_S = 10.0
_GOOD_AFTER_S = 5.0
_log = UpLogger.get_logger("cluster")

OnMessage = Callable[[nats.Message], object]


class NatsClient:
    """Publishes, subscribes and requests; every call returns without waiting for the network.

    `start` it, then use it: subscriptions survive a change of the server. Messages without
    a connection are dropped and counted, as are the oldest messages behind a slow server.
    `on_connected(bool)` is called at each change. The reactor's thread only. A reactor with
    `attach(transport, on_data)` hands the received data over, and returns what writes the messages.
    """

    def __init__(
        self,
        reactor: Any,
        servers: Sequence[Server],
        *,
        name: str,
        login: Mapping[str, str] | None = None,
        tls: TLSFiles | None = None,
        on_connected: Callable[[bool], object] = lambda _: None,
    ) -> None:
        self._reactor = reactor
        self.attach: Callable[..., Callable[[bytes], None]] = getattr(reactor, "attach", _attach)
        self._servers = deque(servers)
        self._tls = tls
        self._on_connected = on_connected
        self.options = {
            "verbose": False,
            "pedantic": False,
            "echo": False,
            "headers": True,
            "no_responders": True,
            "protocol": 1,
            "lang": "python-twisted",
            "version": VERSION,
            "name": name,
            "tls_required": tls is not None,
            **(login or {}),
        }
        self._limited = Limited(reactor, LOG_INTERVAL_S)
        self._backoff = Backoff()
        self._began_s = 0.0
        self._ready_s: float | None = None
        factory: Any = Factory.forProtocol(self._build)
        factory.noisy = False
        make: Any = ClientService
        self._service = make(self, factory, retryPolicy=self._pause_s, clock=reactor)
        self._link: NatsLink | None = None
        self._attempted: NatsLink | None = None
        self._subscriptions: dict[int, tuple[str, OnMessage]] = {}
        self.payloads: dict[bytes, Callable[[bytes], object]] = {}
        """The callbacks of `subscribe_payloads`, by the bytes of their sid, for the parser."""
        self._next_sid = 1
        self._inbox = f"_INBOX.{secrets.token_hex(8)}"
        self._next_request = 0
        self._requests: dict[str, Deferred[nats.Message]] = {}
        self.dropped = 0
        """Messages that were published but never left."""
        self.failures: deque[tuple[str, str]] = deque(maxlen=len(servers))
        """Code and reason of the last failed connections, one of each server, since a good one."""

    def start(self) -> None:
        self.subscribe(f"{self._inbox}.*", self._on_answer)
        self._service.startService()

    async def stop(self) -> None:
        """Send what waits as far as the server reads it, and disconnect."""
        if self._attempted is not None:
            # A registered producer would keep the connection open.
            self._attempted.transport.unregisterProducer()
        self._link = None
        await self._service.stopService()
        self._fail_requests()
        self._limited.stop()

    @property
    def is_connected(self) -> bool:
        return self._link is not None

    def publish(self, subject: str, payload: bytes, reply: str = "") -> None:
        """Send a message that may be dropped. Raises ValueError for an invalid subject."""
        self._publish(nats.publish(subject, payload, reply))

    def publisher(self, subject: str) -> Callable[[bytes], None]:
        """Return what publishes to one subject, in fewer calls. Raises ValueError."""
        to = nats.checked(subject)

        def publish(payload: bytes) -> None:
            # The path of every relayed line: avoid every unnecessary call.
            frame = nats.PUB % (to, len(payload), payload)
            link = self._link
            if link is None or link.is_paused:
                self._publish(frame)
            else:
                link.write(frame)

        return publish

    def _publish(self, frame: bytes) -> None:
        link = self._link
        if link is None:
            self.dropped += 1
        elif link.is_paused:
            self.dropped += link.keep(frame)
        else:
            link.write(frame)

    def subscribe(self, subject: str, on_message: OnMessage) -> int:
        """Call `on_message` for each message; return the handle for `unsubscribe`."""
        sid, self._next_sid = self._next_sid, self._next_sid + 1
        line = nats.subscribe(subject, sid)
        self._subscriptions[sid] = subject, on_message
        if self._link is not None:
            self._link.send(line)
        return sid

    def subscribe_payloads(self, subject: str, on_payload: Callable[[bytes], object]) -> int:
        """Call `on_payload` for each payload, in fewer calls than `subscribe`; it may not raise."""
        sid = self.subscribe(subject, lambda message: on_payload(message.payload))
        self.payloads[b"%d" % sid] = on_payload
        return sid

    def unsubscribe(self, sid: int) -> None:
        """End a subscription. Raises KeyError for an unknown handle."""
        del self._subscriptions[sid]
        self.payloads.pop(b"%d" % sid, None)
        if self._link is not None:
            self._link.send(nats.unsubscribe(sid))

    async def request(
        self,
        subject: str,
        payload: bytes,
        *,
        headers: Mapping[str, str] | None = None,
        limit_s: float = REQUEST_LIMIT_S,
    ) -> nats.Message:
        """Return the first answer. Raises UnavailableError; a request is never dropped."""
        if self._link is None:
            raise UnavailableError("no_connection")
        self._next_request += 1
        key = str(self._next_request)
        answer: Deferred[nats.Message] = Deferred()
        self._requests[key] = answer
        self._link.send(nats.publish(subject, payload, f"{self._inbox}.{key}", headers))
        timer = self._reactor.callLater(limit_s, self._fail_request, key, "timeout")
        try:
            message = await answer
        except CancelledError:
            raise UnavailableError("timeout") from None
        finally:
            cancel(timer)
            self._requests.pop(key, None)
        if message.header and nats.parse_headers(message.header)[0] == 503:
            raise UnavailableError("no_responders")
        return message

    def connect(self, protocolFactory: Any) -> Deferred[Any]:  # noqa: N803 - Twisted's name
        """Make one attempt, at the next server; the service calls it as its endpoint."""
        self._began_s = self._reactor.seconds()
        server = self._servers[0]
        self._servers.rotate(-1)
        make: Any = HostnameEndpoint
        if isIPAddress(server.host):
            make = TCP4ClientEndpoint
        elif isIPv6Address(server.host):
            make = TCP6ClientEndpoint
        endpoint: Any = make(self._reactor, server.host, server.port, CONNECT_LIMIT_S)
        if self._tls is not None:
            endpoint = TLSClientEndpoint(self._reactor, endpoint, self._tls, server.host)
        attempt: Deferred[Any] = endpoint.connect(protocolFactory)
        return attempt.addErrback(self._on_failed, server)

    def _on_failed(self, failure: Failure, server: Server) -> Failure:
        if not failure.check(CancelledError):
            self._log_lost(server, getattr(failure.value, "code", "no_connection"), failure.value)
        return failure

    def _log_lost(self, server: Server | str, code: str, reason: object) -> None:
        where = server if isinstance(server, str) else f"{server.host}:{server.port}"
        text = str(reason).strip().rstrip(".")
        self.failures.append((code, text))
        self._limited.log(
            _log.warn,
            "no connection to NATS at {server}: {reason}",
            key=where,
            code=code,
            server=where,
            reason=text,
        )

    def _pause_s(self, failed_attempts: int) -> float:
        now_s = self._reactor.seconds()
        if self._ready_s is not None and now_s - self._ready_s >= _GOOD_AFTER_S:
            self._backoff.reset()
        self._ready_s = None
        return self._backoff.pause_s(now_s - self._began_s)

    def _build(self) -> "NatsLink":
        last = self._servers[-1]
        self._attempted = NatsLink(self, self._reactor, f"{last.host}:{last.port}")
        return self._attempted

    def on_ready(self, link: "NatsLink") -> None:
        """Use a link whose server has accepted CONNECT."""
        self._link, self._ready_s = link, self._reactor.seconds()
        self.failures.clear()
        subjects = [(subject, sid) for sid, (subject, _) in self._subscriptions.items()]
        link.send(b"".join(itertools.starmap(nats.subscribe, subjects)))
        _log.info("connected to NATS server {server}", code="nats_connected", server=link.server)
        self._on_connected(True)

    def on_lost(self, link: "NatsLink", code: str, reason: str) -> None:
        if link is self._attempted:
            self._attempted = None
        if link is not self._link:
            if code != "closed":
                self._log_lost(link.server, code, reason)
            return
        self._link = None
        self.dropped += link.waiting
        self._log_lost(link.server, code, reason)
        self._fail_requests()
        self._on_connected(False)

    def on_message(self, message: nats.Message) -> None:
        subscribed = self._subscriptions.get(message.sid)
        if subscribed is not None:
            try:
                subscribed[1](message)
            except Exception:  # noqa: BLE001 - a bug costs one message, not the connection
                _log.failure("a message failed on a bug", code="cluster_bug")

    def _on_answer(self, message: nats.Message) -> None:
        answer = self._requests.pop(message.subject.rpartition(".")[2], None)
        if answer is not None:
            answer.callback(message)

    def _fail_request(self, key: str, code: str) -> None:
        answer = self._requests.pop(key, None)
        if answer is not None:
            answer.errback(UnavailableError(code))

    def _fail_requests(self) -> None:
        for key in list(self._requests):
            self._fail_request(key, "no_connection")


class NatsLink(Protocol):
    """One connection to a server: INFO, CONNECT, then messages until it is lost."""

    transport: Any
    write: Callable[[bytes], None]

    def __init__(self, client: NatsClient, clock: Clock, server: str) -> None:
        self._client = client
        self._clock = clock
        self._seconds = clock.seconds
        self._parser = nats.NatsParser(self._on_event, client.payloads)
        self._ping: Timer | None = None
        self._last_rx_s = 0.0
        self._is_ready = False
        self.is_paused = False
        self._data: deque[bytes] = deque()
        self._data_bytes = 0
        self._failed: tuple[str, str] | None = None
        self.server = server
        """Its address, later its name."""

    @property
    def waiting(self) -> int:
        """Messages that wait for the server."""
        return len(self._data)

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        self.transport.registerProducer(self, True)
        self.transport.setTcpNoDelay(True)
        self.write = self._client.attach(self.transport, self.dataReceived)
        self._last_rx_s = self._seconds()
        self._ping = self._clock.callLater(PING_S, self._on_ping_due)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        self._last_rx_s = self._seconds()
        try:
            self._parser.feed(data)
        except nats.NatsProtocolError as error:
            self._fail(error.code, str(error))

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        cancel(self._ping)
        default = "closed" if reason.check(ConnectionDone) else "no_connection"
        code = getattr(reason.value, "code", default)
        code, text = self._failed or (code, reason.getErrorMessage())
        self._client.on_lost(self, code, text)

    def send(self, frame: bytes) -> None:
        """Send a frame that is never dropped."""
        self.write(frame)

    def keep(self, frame: bytes) -> int:
        """Keep a message for a slow server; return how many older ones were dropped."""
        self._data.append(frame)
        self._data_bytes += len(frame)
        dropped = 0
        while self._data_bytes > MAX_WAITING_BYTES:
            self._data_bytes -= len(self._data.popleft())
            dropped += 1
        return dropped

    def pauseProducing(self) -> None:  # noqa: N802 - Twisted's name
        self.is_paused = True

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        self.is_paused = False
        while self._data and not self.is_paused:
            frame = self._data.popleft()
            self._data_bytes -= len(frame)
            self.transport.write(frame)

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: connectionLost follows."""

    def _on_event(self, event: nats.Event) -> None:
        if isinstance(event, nats.Message):
            self._client.on_message(event)
        elif isinstance(event, nats.Ping):
            self.send(nats.PONG)
        elif isinstance(event, nats.Info):
            self.server = str(event.fields.get("server_name", self.server))
            if event.fields.get("tls_required") and not self._client.options["tls_required"]:
                self._fail("nats_refused", "it requires TLS: set 'tls'")
            elif not self._is_ready:
                self.send(nats.connect(self._client.options) + nats.PING)
            elif event.fields.get("ldm"):
                self._fail("lame_duck", "the server is about to end")
        elif isinstance(event, nats.Failed):
            if not event.text.lower().startswith("permissions violation"):
                self._fail("nats_refused", event.text)
            else:
                _log.error("NATS refuses: {reason}", code="nats_permission", reason=event.text)
        elif not self._is_ready:
            self._is_ready = True
            self._client.on_ready(self)

    def _fail(self, code: str, reason: str) -> None:
        self._failed = self._failed or (code, reason)
        self.transport.abortConnection()

    def _on_ping_due(self) -> None:
        if self._seconds() - self._last_rx_s > SILENCE_S:
            self._fail("silent", f"nothing received for {SILENCE_S:g} s")
            return
        self._ping = self._clock.callLater(PING_S, self._on_ping_due)
        if self._is_ready:
            self.send(nats.PING)


def _attach(transport: Any, _: Callable[[bytes], object]) -> Callable[[bytes], None]:
    write: Callable[[bytes], None] = transport.write
    return write
