"""Serves metrics in the text format of Prometheus, and the health, to the local machine."""

import json
from collections.abc import Callable
from http import HTTPStatus
from typing import Any, NamedTuple

from twisted.internet.protocol import connectionDone
from twisted.protocols.policies import ProtocolWrapper, WrappingFactory
from twisted.python.failure import Failure
from twisted.web.http import Request
from twisted.web.resource import Resource
from twisted.web.server import Request as SiteRequest
from twisted.web.server import Site

from up.system.clock import Clock, cancel
from up.system.http_host import names_this_machine
from up.system.lingering_connection import LingeringConnection

HOST = "127.0.0.1"
CONTENT_TYPE = "text/plain; version=0.0.4; charset=utf-8"
MAX_CONNECTIONS = 16
MAX_REQUEST_BYTES = 8192
CONNECTION_LIMIT_S = 5.0
"""From the accepted connection to the end of the lingering close."""
MISDIRECTED_REQUEST = 421
_TOO_LARGE = b"HTTP/1.1 431 Request Header Fields Too Large\r\nConnection: close\r\n\r\n"


class Answer(NamedTuple):
    """The answer of a page."""

    content_type: str
    text: str
    status: int = HTTPStatus.OK


class LocalPage(Resource):
    """A page of a program, for its own machine."""

    isLeaf = True  # noqa: N815 - Twisted's name

    def __init__(self, answer: Callable[[], Answer]) -> None:
        super().__init__()  # type: ignore[no-untyped-call]
        self._answer = answer

    def render_GET(self, request: Request) -> bytes:  # noqa: N802 - Twisted's name
        """Return the current answer; refuses a Host that does not name this machine."""
        hosts = request.requestHeaders.getRawHeaders("Host", [])
        if len(hosts) != 1 or not names_this_machine(hosts[0], {"localhost"}):
            request.setResponseCode(MISDIRECTED_REQUEST, b"Misdirected Request")
            return b"open this page as localhost or by its address\n"
        answer = self._answer()
        request.setResponseCode(answer.status)
        request.setHeader("Content-Type", answer.content_type)
        return answer.text.encode("utf-8")

    def render_HEAD(self, request: Request) -> bytes:  # noqa: N802 - Twisted's name
        """Return no body, which Twisted would report for each request."""
        self.render_GET(request)
        return b""


def health(code: str, status: int = HTTPStatus.OK) -> Answer:
    """Return the answer of a health page, a JSON object with a code."""
    return Answer("application/json", json.dumps({"code": code}) + "\n", status)


def readiness(unready_code: str) -> Answer:
    """Return the answer of `/ready`: status 503 for a code."""
    if unready_code:
        return health(unready_code, HTTPStatus.SERVICE_UNAVAILABLE)
    return health("ready")


class OnlyRequest(SiteRequest):
    """A request that is the only one of its connection."""

    channel: Any

    def gotLength(self, length: int | None) -> None:  # noqa: N802 - Twisted's name
        self.channel.persistent = 0
        self.responseHeaders.setRawHeaders(b"Connection", [b"close"])
        super().gotLength(length)  # type: ignore[no-untyped-call]


class MetricsConnection(LingeringConnection):
    """Bounds the size of a request and the time until the peer has closed."""

    factory: Any
    _left_bytes = MAX_REQUEST_BYTES

    def makeConnection(self, transport: Any) -> None:  # noqa: N802 - Twisted's name
        clock: Clock = self.factory.clock
        self._limit = clock.callLater(CONNECTION_LIMIT_S, transport.abortConnection)
        super().makeConnection(transport)  # type: ignore[no-untyped-call]

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        """Pass on a request of bounded size; discard excess data."""
        super().dataReceived(data[: max(0, self._left_bytes)])
        self._left_bytes -= len(data)
        if self._left_bytes < 0 and not self.disconnecting:
            self.transport.write(_TOO_LARGE)
            self.loseConnection()

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        cancel(self._limit)
        super().connectionLost(reason)  # type: ignore[no-untyped-call]


class MetricsFactory(WrappingFactory):
    """Keeps at most MAX_CONNECTIONS connections, the newest; `clock` times them."""

    protocol = MetricsConnection
    noisy = False

    def __init__(
        self, clock: Clock, page: Callable[[], str], unready_code: Callable[[], str] | None = None
    ) -> None:
        root: Any = Resource()
        root.putChild(b"metrics", LocalPage(lambda: Answer(CONTENT_TYPE, page())))
        if unready_code is not None:
            root.putChild(b"live", LocalPage(lambda: health("live")))
            root.putChild(b"ready", LocalPage(lambda: readiness(unready_code())))
        make: Any = Site
        site = make(root, requestFactory=OnlyRequest, timeout=None, reactor=clock)
        site.displayTracebacks = False
        site.noisy = False
        super().__init__(site)  # type: ignore[no-untyped-call]
        self.clock = clock

    def registerProtocol(self, p: ProtocolWrapper) -> None:  # noqa: N802 - Twisted's name
        """Make room for a new connection: the oldest is the slowest."""
        if len(self.protocols) >= MAX_CONNECTIONS:
            oldest = next(iter(self.protocols))
            self.unregisterProtocol(oldest)
            oldest.transport.abortConnection()
        super().registerProtocol(p)  # type: ignore[no-untyped-call]

    def unregisterProtocol(self, p: ProtocolWrapper) -> None:  # noqa: N802 - Twisted's name
        self.protocols.pop(p, None)


def serve_metrics(
    reactor: Any,
    port: int,
    page: Callable[[], str],
    unready_code: Callable[[], str] | None = None,
) -> Any:
    """Serve `page()` at http://127.0.0.1:port/metrics and return the listening port.

    `unready_code()` returns why the program accepts no new work, or an empty text: with it there
    are also /live and /ready. Raises CannotListenError.
    """
    return reactor.listenTCP(port, MetricsFactory(reactor, page, unready_code), interface=HOST)
