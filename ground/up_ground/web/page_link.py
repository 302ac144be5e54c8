"""A page's WebSocket."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from autobahn.twisted.resource import WebSocketResource
from autobahn.twisted.websocket import WebSocketServerFactory, WebSocketServerProtocol
from twisted.internet.interfaces import IAddress

from up.protocols.tcp_options import watch_peer
from up_ground.web.client_session import PageSendBuffer
from up_ground.web.sessions import token_of

if TYPE_CHECKING:
    from up_ground.web.client_hub import ClientHub

USER_TIMEOUT_MS = 5000
PING_S = 5.0
MAX_HELLO_BYTES = 1024
"""Limit of a message before its page is welcomed, bytes."""
NOT_TEXT = 4003
TOO_LONG = 4008


class PageLink(WebSocketServerProtocol):
    """Text messages both ways; output goes through ``output``, past the library's own queue."""

    transport: Any
    host: str
    """Its remote address."""
    session = ""
    """The token in its cookie."""
    may_send_secrets = False

    def __init__(self, owner: ClientHub, clock: Any, is_https: bool) -> None:
        super().__init__()
        self._is_https = is_https
        self.output = PageSendBuffer(self._on_overrun)
        self._owner = owner
        self._clock = clock
        self._is_open = False
        self._asked: dict[bytes, Callable[[bool], object]] = {}

    def onConnect(self, request: Any) -> None:  # noqa: N802 - the library's name
        self.host = str(self.transport.getPeer().host)
        self.session = token_of(request.headers.get("cookie"), self.transport.getHost().port)
        self.may_send_secrets = self._owner.access.permits_secrets(
            self.host, request.headers.get("origin"), self._is_https
        )

    def onOpen(self) -> None:  # noqa: N802 - the library's name
        # The transport of the HTTP request is still registered there.
        self.transport.unregisterProducer()
        watch_peer(self.transport, USER_TIMEOUT_MS)
        self.output.start(self.transport)
        self._is_open = True
        self._owner.on_opened(self)

    def admit(self, max_bytes: int) -> None:
        """Accept messages up to this size, and leave the limits of strangers."""
        self.maxMessagePayloadSize = self.maxFramePayloadSize = max_bytes
        self.transport.admit()

    def onMessage(self, payload: bytes, isBinary: bool) -> None:  # noqa: N802, N803
        if isBinary:
            self.close(NOT_TEXT, "only text messages")
        elif self._is_open:
            self._owner.on_message(self, payload)

    def onPong(self, payload: bytes) -> None:  # noqa: N802 - the library's name
        notify = self._asked.pop(payload, None)
        if notify is not None:
            notify(True)

    def onClose(self, wasClean: bool, code: int | None, reason: str | None) -> None:  # noqa: N802, N803
        self.output.stopProducing()
        asked, self._asked = self._asked, {}
        for notify in asked.values():
            notify(False)
        if self._is_open:
            self._is_open = False
            self._owner.on_closed(self)

    def is_alive(self, within_s: float, notify: Callable[[bool], object]) -> None:
        """Ping the page; ``notify`` gets once whether the answer came in time."""
        mark = b"%d" % id(notify)
        self._asked[mark] = notify

        def on_time_over() -> None:
            if self._asked.pop(mark, None) is not None:
                notify(False)

        self._clock.callLater(within_s, on_time_over)
        self.sendPing(mark)

    def close(self, code: int, reason: str) -> None:
        """Close it; ``code`` is 4000 to 4999, as RFC 6455 leaves them to us."""
        self.output.finish()
        self.sendClose(code, reason)

    def _max_message_size_exceeded(self, msg_size: int, max_msg_size: int, reason: str) -> None:
        """Send the reason, where the library would cut the connection without one."""
        # Later input is not stored.
        self.failedByMe = True
        self.close(TOO_LONG, f"a message has at most {max_msg_size} bytes")

    def _on_overrun(self) -> None:
        # It has not read for long: a closing handshake would wait behind all of that.
        self.transport.abortConnection()


class _Factory(WebSocketServerFactory):
    noisy = False

    def __init__(self, reactor: Any, owner: ClientHub, is_https: bool) -> None:
        super().__init__(  # type: ignore[no-untyped-call]
            reactor=reactor, server="up-ground"
        )
        self._owner = owner
        self._is_https = is_https
        configure: Any = self.setProtocolOptions
        configure(
            webStatus=False,
            versions=[13],
            maxFramePayloadSize=MAX_HELLO_BYTES,
            maxMessagePayloadSize=MAX_HELLO_BYTES,
            openHandshakeTimeout=5.0,
            closeHandshakeTimeout=1.0,
            autoPingInterval=PING_S,
            autoPingTimeout=2 * PING_S,
            tcpNoDelay=True,
        )

    def buildProtocol(self, addr: IAddress | None) -> PageLink:  # noqa: N802 - Twisted's name
        link = PageLink(self._owner, self.reactor, self._is_https)
        link.factory = self
        return link


def link_resource(reactor: Any, owner: ClientHub, is_https: bool) -> WebSocketResource:
    """Return the resource that upgrades a request; Host and Origin are checked before."""
    return WebSocketResource(_Factory(reactor, owner, is_https))
