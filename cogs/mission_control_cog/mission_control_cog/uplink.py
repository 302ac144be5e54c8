"""The link to the proxy, which reconnects without limit."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.application.internet import ClientService
from twisted.internet.defer import Deferred
from twisted.internet.endpoints import TCP4ClientEndpoint, TCP6ClientEndpoint
from twisted.internet.error import ConnectError
from twisted.internet.interfaces import IProtocolFactory, IStreamClientEndpoint
from twisted.internet.protocol import Factory
from twisted.logger import Logger
from zope.interface import implementer

from mission_control_cog.host_addresses import HostAddresses, HostNotFoundError
from mission_control_cog.uplink_protocol import UplinkProtocol
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


@implementer(IStreamClientEndpoint)
class Uplink:
    """Connects, sends the hello, and retries after every failure and loss.

    ``hello`` is the aircraft's name, None for a legacy client. The token of the last link resumes
    the aircraft's lease at the proxy immediately. Data sent without a link are lost. With ``tls``
    there is no plain attempt.
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
        self._counted = 0
        self._began_s = 0.0
        self._ready_s: float | None = None
        self._reported = ""
        factory: Any = Factory.forProtocol(self._build)
        factory.noisy = False
        make: Any = ClientService
        self._service = make(self, factory, retryPolicy=self._pause_s, clock=reactor)

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

        ``lines`` makes of the packed body, when it leaves, what is sent of it; ``whole_s`` and
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
        return more

    def start(self) -> None:
        self._service.startService()

    async def stop(self) -> None:
        """Close the link, or abandon the attempt, and stop retrying."""
        link = self._link
        if link is not None:
            link.close()
        await self._service.stopService()

    def connect(self, protocolFactory: IProtocolFactory) -> Deferred[Any]:  # noqa: N803
        """Make one attempt; the service calls it as its endpoint."""
        self._began_s = self._reactor.seconds()
        return Deferred.fromCoroutine(self._attempt(protocolFactory))

    async def _attempt(self, factory: IProtocolFactory) -> Any:
        address = ""
        try:
            address = await self._addresses.next()
            make = TCP6ClientEndpoint if ":" in address else TCP4ClientEndpoint
            endpoint: Any = make(self._reactor, address, self._port, CONNECT_LIMIT_S)
            if self._tls is not None:
                endpoint = TLSClientEndpoint(self._reactor, endpoint, self._tls, self._host)
            return await endpoint.connect(factory)
        except (ConnectError, OSError, HostNotFoundError) as error:
            self._addresses.failed(address)
            reason = str(error).strip() or type(error).__name__
            self._report("no_connection", f"no connection: {reason}")
            raise
        except TLSError as fault:
            self._addresses.failed(address)
            self._report(fault.code, f"no connection: {fault}")
            raise

    def _pause_s(self, failed_attempts: int) -> float:
        now_s = self._reactor.seconds()
        if self._ready_s is not None and now_s - self._ready_s >= GOOD_AFTER_S:
            self._backoff.reset()
        self._ready_s = None
        return self._backoff.pause_s(now_s - self._began_s)

    def _build(self) -> UplinkProtocol:
        self._counted = 0
        self._link = UplinkProtocol(
            self._reactor,
            None if self._hello is None else Hello(self._hello, token=self._token, packed=True),
            on_token=self._take_token,
            on_ready=self._ready,
            on_message=lambda link, message: self._on_message(message),
            on_malformed=lambda link, fault: self._on_malformed(fault),
            on_lost=self._link_lost,
            on_binary=None if (take := self._on_binary) is None else lambda _, line: take(line),
            bucket=self.bucket,
        )
        return self._link

    def _take_token(self, token: str) -> None:
        self._token = token

    def _ready(self, link: UplinkProtocol) -> None:
        self.connects += 1
        self._ready_s = self._reactor.seconds()
        self._reported = ""
        security = "plain" if self._tls is None else f"TLS with {link.transport.peer_name}"
        text = "connected to {peer}, {security}"
        self.log.info(text, peer=link.peer, security=security, code="uplink_connected")
        self._on_ready(link.peer.rpartition(":")[0])

    def _link_lost(self, link: UplinkProtocol, reason: str) -> None:
        self._link = None
        if self._ready_s is not None:
            self._on_lost()
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
