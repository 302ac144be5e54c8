"""Serves the metrics page to the local machine."""

from collections.abc import Callable
from typing import Any, Protocol

from twisted.internet.error import CannotListenError
from twisted.web.http import Request
from twisted.web.resource import Resource
from twisted.web.server import Site

from up_proxy.listener import cannot_listen
from up_proxy.metrics_page import CONTENT_TYPE

HOST = "127.0.0.1"
_TIMEOUT_S = 10


class MetricsPage(Resource):
    """The page at /metrics."""

    isLeaf = True  # noqa: N815 - Twisted's name

    def __init__(self, page: Callable[[], str]) -> None:
        super().__init__()  # type: ignore[no-untyped-call]
        self._page = page

    def render_GET(self, request: Request) -> bytes:  # noqa: N802 - Twisted's name
        """Return the figures of this moment."""
        request.setHeader("Content-Type", CONTENT_TYPE)
        return self._page().encode("utf-8")


class TcpReactor(Protocol):
    """What serving asks of the reactor."""

    def listenTCP(  # noqa: N802 - Twisted's name
        self, port: int, factory: Any, backlog: int = 50, interface: str = ""
    ) -> Any:
        """Listen on a TCP port."""


def serve_metrics(reactor: TcpReactor, port: int, page: Callable[[], str]) -> Any:
    """Serve `page()` at http://127.0.0.1:port/metrics and return the listening port.

    Raises ListenError.
    """
    root: Any = Resource()
    root.putChild(b"metrics", MetricsPage(page))
    site = Site(root, timeout=_TIMEOUT_S)
    site.displayTracebacks = False
    site.noisy = False
    try:
        return reactor.listenTCP(port, site, interface=HOST)
    except CannotListenError as error:
        raise cannot_listen("metrics port", port, error.socketError) from None
