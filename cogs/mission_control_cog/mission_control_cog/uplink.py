"""The link to the proxy, which reconnects without limit."""

from collections.abc import Callable, Sequence
from typing import Any

from twisted.internet.defer import Deferred, TimeoutError
from twisted.internet.error import ConnectError
from twisted.internet.interfaces import IProtocolFactory, IStreamClientEndpoint
from twisted.internet.protocol import Factory
from twisted.logger import Logger
from zope.interface import implementer

from mission_control_cog.host_addresses import HostAddresses, HostNotFoundError
from mission_control_cog.uplink_paths import UplinkPaths, client_endpoint
from mission_control_cog.uplink_protocol import HEARTBEAT_S, UplinkProtocol
from up.protocols.general_message import GeneralMessage, MalformedMessage
from up.protocols.general_message_link import MAX_BURST, MAX_MESSAGES_HZ
from up.protocols.packed_telemetry import IsEnough
from up.protocols.proxy_lines import Hello
from up.system.backoff import Backoff
from up.system.token_bucket import TokenBucket
from up.tls.errors import TLSError
from up.tls.files import TLSFiles
from up.tls.protocol import TLSClientEndpoint

CONNECT_LIMIT_S = 5.0
"""Within it the kernel repeats a lost SYN after 1 and 3 s."""
GOOD_AFTER_S = 3.0
PATHS_HEARTBEAT_S = 0.4
"""Of a link with several paths: what it sends shows whether its path lives."""


@implementer(IStreamClientEndpoint)
class Uplink:
    """Connects, sends the hello, and retries after every failure and loss.

    ``hello`` is the aircraft's name, None for a legacy client. The token of the last link resumes
    the aircraft's lease at the proxy immediately. Data sent without a link are lost. With ``tls``
    there is no plain attempt. ``interfaces`` are the network interfaces that may carry the link,
    the best first; without any the system chooses.
    """

    log = Logger()

    def __init__(
        self,
        reactor: Any,
        host: str,
        port: int,
        hello: str | None,
        *,
        on_message: Callable[[GeneralMessage], object],
        on_malformed: Callable[[MalformedMessage], object],
        on_binary: Callable[[bytes], object] | None = None,
        on_ready: Callable[[str], object],
        on_lost: Callable[[], object],
        backoff: Backoff | None = None,
        tls: TLSFiles | None = None,
        interfaces: Sequence[str] = (),
        return_after_s: float = 0.0,
    ) -> None:
        self.connects = 0
        self.bucket = TokenBucket(reactor, MAX_MESSAGES_HZ, MAX_BURST)
        self._reactor = reactor
        self._host = host
        self._port = port
        self._tls = tls
        self._hello = hello
        self._token = ""
        self._on_message = on_message
        self._on_malformed = on_malformed
        self._on_binary = on_binary
        self._on_ready = on_ready
        self._on_lost = on_lost
        self._backoff = backoff or Backoff()
        self._addresses = HostAddresses(reactor, host, port)
        self._link: UplinkProtocol | None = None
        self._attempted: UplinkProtocol | None = None
        self._counted = 0
        self._began_s = 0.0
        self._ready_s: float | None = None
        self._reported = ""
        self._paths: UplinkPaths | None = None
        if interfaces:
            self._paths = UplinkPaths(reactor, interfaces, return_after_s, self._leave)
        self._service = self._new_service()
        self._left: Any = None
        """The service of the present link while another path is tried."""

    @property
    def path(self) -> str | None:
        """Return the interface of the link or of its newest attempt; None: the system's choice."""
        return None if self._paths is None else self._paths.name

    @property
    def is_protected(self) -> bool:
        """Return whether only a proxy with a valid certificate can be the peer."""
        return self._tls is not None

    @property
    def is_ready(self) -> bool:
        return self._link is not None and self._link.is_ready

    def send(self, message: bytes) -> bool:
        """Send in order; False without a link, or if too much waits."""
        return self._link is not None and self._link.send(message)

    def send_newest(self, message: bytes) -> bool:
        """Send in place of an older unsent message."""
        return self._link is not None and self._link.send_newest(message)

    def send_packed(
        self,
        frame: bytes,
        lines: Callable[[bytes], bytes],
        whole_s: float = 0.0,
        is_enough: IsEnough | None = None,
    ) -> bool:
        """Send a frame of telemetry packed, in place of an older unsent message.

        ``lines`` makes of the packed body, when it leaves, the lines that carry it; ``whole_s`` and
        ``is_enough`` are those of Packer.pack.
        """
        link = self._link
        return link is not None and link.send_packed(frame, lines, whole_s, is_enough)

    @property
    def may_pack(self) -> bool:
        return self._link is not None and self._link.may_pack

    @property
    def may_shorten(self) -> bool:
        return self._link is not None and self._link.may_shorten

    @property
    def grounds(self) -> int | None:
        """Return how many ground stations the proxy counts; None: it does not tell."""
        watchers = None if self._link is None else self._link.watchers
        return None if watchers is None else watchers.grounds

    def take_ip_bytes(self) -> int:
        """Return what the link has cost since the last call, both ways with headers."""
        counted = None if self._link is None else self._link.ip_bytes()
        more = 0 if counted is None else counted - self._counted
        self._counted += more
        if self._paths is not None:
            more += self._paths.take_probe_bytes()
        return more

    def start(self) -> None:
        if self._paths is not None:
            self._paths.start()
        self._service.startService()

    async def stop(self) -> None:
        """Close the link, or abandon the attempt, and stop retrying."""
        if self._paths is not None:
            self._paths.stop()
        for link in (self._link, self._attempted):
            if link is not None:
                link.close()
        for service in (self._left, self._service):
            if service is not None:
                await service.stopService()

    def connect(self, protocolFactory: IProtocolFactory) -> Deferred[Any]:  # noqa: N803
        """Make one attempt; the service calls it as its endpoint."""
        self._began_s = self._reactor.seconds()
        return Deferred.fromCoroutine(self._attempt(protocolFactory))

    async def _attempt(self, factory: IProtocolFactory) -> Any:
        address = ""
        try:
            address = await self._addresses.next()
            reactor, limit_s = self._reactor, None
            if self._paths is not None:
                reactor, limit_s = self._paths.next(address, self._port)
            endpoint = client_endpoint(reactor, address, self._port, limit_s or CONNECT_LIMIT_S)
            if self._tls is not None:
                endpoint = TLSClientEndpoint(self._reactor, endpoint, self._tls, self._host)
            connecting: Deferred[Any] = endpoint.connect(factory)
            if limit_s is not None:
                connecting.addTimeout(limit_s, self._reactor)
            return await connecting
        except (ConnectError, OSError, HostNotFoundError, TimeoutError) as error:
            self._failed(address)
            reason = str(error).strip().rstrip(".") or type(error).__name__
            code = getattr(error, "code", "no_connection")
            self._report(code, f"no connection: {reason}")
            raise
        except TLSError as fault:
            self._failed(address)
            self._report(fault.code, f"no connection: {fault}")
            raise

    def _failed(self, address: str) -> None:
        self._addresses.failed(address)
        if address:
            self._stay()

    def _new_service(self) -> Any:
        factory: Any = Factory.forProtocol(self._build)
        factory.noisy = False
        # Imported here: an aircraft without a server need not wait for it.
        from twisted.application.internet import ClientService

        make: Any = ClientService
        return make(self, factory, retryPolicy=self._pause_s, clock=self._reactor)

    def _leave(self, code: str, reason: str) -> None:
        """Connect by another path; the present link stays until the proxy has taken the new one."""
        self.log.warn("{reason}", reason=reason, code=code)
        self._left, self._service = self._service, self._new_service()
        self._service.startService()

    def _stay(self) -> None:
        """Keep the present link, if there is one: the attempt failed."""
        if self._paths is not None:
            self._paths.failed()
        if self._left is not None:
            given_up, self._service, self._left = self._service, self._left, None
            self._reactor.callLater(0, given_up.stopService)

    def _pause_s(self, failed_attempts: int) -> float:
        now_s = self._reactor.seconds()
        if self._ready_s is not None and now_s - self._ready_s >= GOOD_AFTER_S:
            self._backoff.reset()
        self._ready_s = None
        return self._backoff.pause_s(now_s - self._began_s)

    def _build(self) -> UplinkProtocol:
        self._attempted = UplinkProtocol(
            self._reactor,
            None if self._hello is None else Hello(self._hello, token=self._token, packed=True),
            on_token=self._take_token,
            on_ready=self._ready,
            on_message=lambda link, message: self._on_message(message),
            on_malformed=lambda link, fault: self._on_malformed(fault),
            on_lost=self._link_lost,
            on_binary=None if (take := self._on_binary) is None else lambda _, line: take(line),
            bucket=self.bucket,
            heartbeat_s=HEARTBEAT_S if self._paths is None else PATHS_HEARTBEAT_S,
        )
        return self._attempted

    def _take_token(self, token: str) -> None:
        # A refused attempt takes no token from the link that it was to replace.
        if token or self._left is None:
            self._token = token

    def _ready(self, link: UplinkProtocol) -> None:
        self.connects += 1
        old, self._link, self._attempted, self._counted = self._link, link, None, 0
        left, self._left = self._left, None
        if left is not None and old is not None:
            old.abort()
            left.stopService()
        if self._paths is not None:
            self._paths.made(link.transport)
        self._ready_s = self._reactor.seconds()
        self._reported = ""
        security = "plain" if self._tls is None else f"TLS with {link.transport.peer_name}"
        path = "" if self.path is None else f", by {self.path}"
        self.log.info(
            "connected to {peer}, {security}{path}",
            peer=link.peer,
            security=security,
            path=path,
            code="uplink_connected",
        )
        self._on_ready(link.peer.rpartition(":")[0])

    def _link_lost(self, link: UplinkProtocol, reason: str) -> None:
        if link is self._link:
            self._link = None
            if self._paths is not None:
                self._paths.ended()
            if self._left is not None:
                self._left.stopService()
                self._left = None
            self._on_lost()
        elif link is self._attempted:
            self._attempted = None
            self._stay()
        else:
            return
        self._report(link.lost_code, f"the link is lost: {reason}")

    def _report(self, code: str, reason: str) -> None:
        if reason != self._reported and self._service.running:
            self._reported = reason
            self.log.warn(
                "{host}:{port}: {reason}; retrying without limit",
                code=code,
                host=self._host,
                port=self._port,
                reason=reason,
            )
