"""The link to the proxy, which reconnects indefinitely."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.internet.defer import CancelledError, Deferred
from twisted.internet.endpoints import TCP4ClientEndpoint, TCP6ClientEndpoint
from twisted.internet.error import ConnectError, ConnectingCancelledError
from twisted.internet.interfaces import IAddress
from twisted.internet.protocol import Factory, Protocol
from twisted.logger import Logger

from mission_control_cog.hello import HelloAnswer
from mission_control_cog.host_addresses import HostAddresses, HostNotFoundError
from mission_control_cog.uplink_protocol import UplinkProtocol
from up.protocols.general_message import GeneralMessage, MalformedMessage
from up.protocols.general_message_link import MAX_BURST, MAX_MESSAGES_HZ
from up.system.backoff import Backoff
from up.system.token_bucket import TokenBucket

CONNECT_LIMIT_S = 5.0
"""Within it the kernel repeats a lost SYN after 1 and 3 s."""
GOOD_AFTER_S = 3.0
_NO_CONNECTION = (
    ConnectError,
    OSError,
    HostNotFoundError,
    CancelledError,
    ConnectingCancelledError,
)


class Uplink:
    """Connects, sends the hello, and retries after every failure and loss.

    ``hello`` is the aircraft's name, None for a thesis client. The token of the last link resumes
    the aircraft's place at the proxy immediately. Data sent without a link is lost.
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
        on_ready: Callable[[str], object],
        on_lost: Callable[[], object],
        backoff: Backoff | None = None,
        addresses: HostAddresses | None = None,
    ) -> None:
        self.connects = 0
        self.bucket = TokenBucket(reactor, MAX_MESSAGES_HZ, MAX_BURST)
        self._reactor = reactor
        self._host = host
        self._port = port
        self._hello = hello
        self._token = ""
        self._on_message = on_message
        self._on_malformed = on_malformed
        self._on_ready = on_ready
        self._on_lost = on_lost
        self._backoff = backoff or Backoff()
        self._addresses = addresses or HostAddresses(reactor, host, port)
        self._link: UplinkProtocol | None = None
        self._ready_s: float | None = None
        self._waiting: Deferred[Any] | None = None
        self._lost: Deferred[str] | None = None
        self._is_stopping = False
        self._ended: Deferred[None] | None = None
        self._said = ""

    @property
    def is_ready(self) -> bool:
        """Return whether messages can be sent."""
        return self._link is not None and self._link.is_ready

    def send(self, message: bytes) -> bool:
        """Send in order; False without a link, or if too much waits."""
        return self._link is not None and self._link.send(message)

    def send_newest(self, message: bytes) -> bool:
        """Send in place of an older unsent message."""
        return self._link is not None and self._link.send_newest(message)

    def start(self) -> None:
        """Start connecting."""
        self._ended = Deferred.fromCoroutine(self._keep_connected())

    async def stop(self) -> None:
        """Close the link, or abandon the attempt, and stop retrying."""
        self._is_stopping = True
        if self._waiting is not None:
            self._waiting.cancel()
        if self._link is not None:
            self._link.close()
        if self._ended is not None:
            await self._ended

    async def _keep_connected(self) -> None:
        while not self._is_stopping:
            began_s = self._reactor.seconds()
            self._say(await self._connect_once())
            if self._ready_s is not None:
                if self._reactor.seconds() - self._ready_s >= GOOD_AFTER_S:
                    self._backoff.reset()
                self._ready_s = None
            await self._pause(self._backoff.pause_s(self._reactor.seconds() - began_s))

    async def _connect_once(self) -> str:
        """Keep one connection from its attempt to its end; return why it ended."""
        self._lost = Deferred()
        self._waiting = Deferred.fromCoroutine(self._attempt())
        try:
            await self._waiting
        except _NO_CONNECTION as error:
            return f"no connection: {_reason(error)}"
        finally:
            self._waiting = None
        return await self._lost

    async def _attempt(self) -> None:
        address = await self._addresses.next()
        make = TCP6ClientEndpoint if ":" in address else TCP4ClientEndpoint
        endpoint = make(self._reactor, address, self._port, CONNECT_LIMIT_S)
        factory: Any = _Factory(self._build)
        try:
            await endpoint.connect(factory)
        except (ConnectError, OSError):
            self._addresses.failed(address)
            raise

    async def _pause(self, delay_s: float) -> None:
        if self._is_stopping:
            return
        done: Deferred[None] = Deferred()
        call = self._reactor.callLater(delay_s, done.callback, None)
        self._waiting = done
        try:
            await done
        except CancelledError:
            call.cancel()
        finally:
            self._waiting = None

    def _build(self) -> UplinkProtocol:
        hello = None if self._hello is None else (self._hello, self._token)
        self._link = UplinkProtocol(
            self._reactor,
            hello,
            on_answer=self._answered,
            on_ready=self._ready,
            on_message=lambda link, message: self._on_message(message),
            on_malformed=lambda link, fault: self._on_malformed(fault),
            on_lost=self._link_lost,
            bucket=self.bucket,
        )
        return self._link

    def _answered(self, answer: HelloAnswer) -> None:
        # A refused token would be refused again: another aircraft now has the name.
        self._token = answer.token

    def _ready(self, link: UplinkProtocol) -> None:
        self.connects += 1
        self._ready_s = self._reactor.seconds()
        self._said = ""
        self.log.info("connected to {peer}", peer=link.peer)
        self._on_ready(link.peer.rpartition(":")[0])

    def _link_lost(self, link: UplinkProtocol, why: str) -> None:
        if link is not self._link:
            return
        self._link = None
        if self._ready_s is not None:
            self._on_lost()
        if self._lost is not None and not self._lost.called:
            self._lost.callback(f"the link is lost: {why}")

    def _say(self, why: str) -> None:
        if why != self._said and not self._is_stopping:
            self._said = why
            self.log.warn(
                "{host}:{port}: {why}; trying again for ever",
                host=self._host,
                port=self._port,
                why=why,
            )


class _Factory(Factory):
    """Builds the one protocol of one attempt."""

    noisy = False

    def __init__(self, build: Callable[[], Protocol]) -> None:
        self._build = build

    def buildProtocol(self, addr: IAddress | None) -> Protocol:  # noqa: N802 - Twisted's name
        return self._build()


def _reason(error: Exception) -> str:
    return str(error).strip() or type(error).__name__
