"""The server's HTTP resources: the page's files, the map's tiles, the link."""

from __future__ import annotations

from http import HTTPStatus
from typing import TYPE_CHECKING, Any

from twisted.web import http
from twisted.web.resource import Resource
from twisted.web.server import Request, Site

from up_ground.web.access import Access
from up_ground.web.documentation import DOCS, allow_scripts
from up_ground.web.static_files import StaticFiles

if TYPE_CHECKING:
    from up_ground.web.tiles import TileSource

IDLE_S = 20.0
"""A connection without a line for this time is closed, as are incomplete requests."""
HEADERS = {
    b"server": b"up-ground",
    b"content-security-policy": (
        b"default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:;"
        b" connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none';"
        b" frame-ancestors 'none'"
    ),
    b"x-content-type-options": b"nosniff",
    b"referrer-policy": b"no-referrer",
    b"cache-control": b"no-cache",
    b"cross-origin-opener-policy": b"same-origin",
    b"cross-origin-resource-policy": b"same-origin",
}
MISDIRECTED_REQUEST = 421
UPGRADE_REQUIRED = 426
_WORDS = {
    MISDIRECTED_REQUEST: b"Misdirected Request",
    UPGRADE_REQUIRED: b"Upgrade Required",
    HTTPStatus.TOO_MANY_REQUESTS: b"Too Many Requests",
}
"""Those that Twisted has no words for."""
LINK = b"/link"
SESSION = b"/session"
TILES = b"/tiles/"
_BODY_REFUSED = (
    b"HTTP/1.1 413 Content Too Large\r\nServer: up-ground\r\nConnection: close\r\n"
    b"Content-Type: text/plain; charset=utf-8\r\n\r\na request here has no body\n"
)
_PLAIN = b"text/plain; charset=utf-8"


class PageResource(Resource):
    """The files of a page; every request passes the checks and gets the headers."""

    isLeaf = True  # noqa: N815 - Twisted's name

    def __init__(self, access: Access, files: StaticFiles) -> None:
        super().__init__()  # type: ignore[no-untyped-call]
        self._access = access
        self._files = files

    def render(self, request: Any) -> Any:
        for name, value in HEADERS.items():
            request.setHeader(name, value)
        if not self._access.permits_host(only(request, b"host")):
            return refuse(
                request,
                MISDIRECTED_REQUEST,
                "unknown host name: open this server by its address, or start it with --name",
            )
        if b"key" in request.args:
            text = "a key does not belong into an address: open this page without it and sign in"
            return refuse(request, http.BAD_REQUEST, text)
        return self.answer(request)

    def answer(self, request: Any) -> Any:
        """Answer a request that passed the checks."""
        if request.method not in (b"GET", b"HEAD"):
            request.setHeader(b"allow", b"GET, HEAD")
            return refuse(request, http.NOT_ALLOWED, "only GET and HEAD")
        return self.get(request)

    def get(self, request: Any) -> Any:
        return self.file(request, request.path)

    def file(self, request: Any, path: bytes) -> bytes:
        found = self._files.get(path)
        if found is None:
            return refuse(request, http.NOT_FOUND, "not found")
        request.setHeader(b"content-type", found.media_type.encode("ascii"))
        if request.setETag(found.etag.encode("ascii")) is http.CACHED:
            return b""
        return send(request, found.content)


class GroundResource(PageResource):
    """The ground station's page, its link and the map's tiles."""

    def __init__(
        self,
        access: Access,
        files: StaticFiles,
        link: Any,
        tiles: TileSource | None = None,
        sign_in: Any = None,
    ) -> None:
        super().__init__(access, files)
        self._sign_in = sign_in
        self._link = link
        self._tiles = tiles

    def answer(self, request: Any) -> Any:
        if request.path == SESSION and self._sign_in is not None:
            return self._refusal_of_origin(request) or self._sign_in.render(request)
        return super().answer(request)

    def get(self, request: Any) -> Any:
        if request.path == LINK:
            return self._render_link(request)
        if request.path.startswith(TILES) and self._tiles is not None:
            return self._tiles.render(request)
        if request.path.startswith(DOCS):
            allow_scripts(request, self._files.get(request.path))
        return super().get(request)

    def _render_link(self, request: Any) -> Any:
        upgrade = only(request, b"upgrade") or ""
        if request.method != b"GET" or upgrade.casefold() != "websocket":
            request.setHeader(b"upgrade", b"websocket")
            return refuse(request, UPGRADE_REQUIRED, "this address is a WebSocket")
        return self._refusal_of_origin(request) or self._link.render(request)

    def _refusal_of_origin(self, request: Any) -> bytes | None:
        """Refuse the page of another site; None: it is from here, or from a program."""
        origins = request.requestHeaders.getRawHeaders(b"origin", [])
        origin, host = only(request, b"origin"), only(request, b"host")
        if (origins and origin is None) or not self._access.permits_origin(origin, host):
            return refuse(request, http.FORBIDDEN, "a page of another site may not connect")
        return None


class GroundRequest(Request):
    """A request without a body: one with a body is refused before anything of it is stored."""

    channel: Any
    _has_body = False

    def gotLength(self, length: int | None) -> None:  # noqa: N802 - Twisted's name
        if length != 0:
            self._has_body = True
            self.requestHeaders.removeHeader(b"expect")
            self.channel.transport.refuse(_BODY_REFUSED)
        super().gotLength(0)  # type: ignore[no-untyped-call]

    def process(self) -> None:
        """Let the resource answer; Twisted itself answers ``*`` with its own name."""
        if self._has_body:
            return
        self.channel.transport.on_request()
        if self.path == b"*":
            self.path = b"/*"
        super().process()  # type: ignore[no-untyped-call]


class _Site(Site):
    noisy = False

    def log(self, request: Any) -> None:
        """Write no line for a request."""


def make_site(reactor: Any, resource: PageResource) -> Site:
    """Return the factory that listens, without an access log."""
    make: Any = _Site
    site: Site = make(resource, requestFactory=GroundRequest, timeout=IDLE_S, reactor=reactor)
    site.displayTracebacks = False
    return site


def refuse(request: Any, code: int, sentence: str) -> bytes:
    """Return an answer with only a reason."""
    request.setResponseCode(code, _WORDS.get(code))
    request.setHeader(b"content-type", _PLAIN)
    return send(request, f"{sentence}\n".encode())


def send(request: Any, content: bytes) -> bytes:
    """Return an answer's body, empty if only its head was requested."""
    request.setHeader(b"content-length", b"%d" % len(content))
    return b"" if request.method == b"HEAD" else content


def finish(request: Any, content: bytes) -> None:
    """Answer a request that was left open; ``content`` is its body as `send` returned it."""
    if content:
        request.write(content)
    request.finish()


def only(request: Any, name: bytes) -> str | None:
    """Return a header that occurs once; None: absent, repeated, or not text."""
    values = request.requestHeaders.getRawHeaders(name, [])
    if len(values) != 1:
        return None
    try:
        return str(values[0].decode("ascii").strip())
    except UnicodeDecodeError:
        return None
