"""The map's pictures, fetched by the server so that a page contacts no other host."""

from __future__ import annotations

import hashlib
import re
from collections import deque
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.protocol import Protocol, connectionDone
from twisted.internet.threads import deferToThreadPool
from twisted.python.failure import Failure
from twisted.web import http
from twisted.web.client import Agent, HTTPConnectionPool, ResponseDone
from twisted.web.http_headers import Headers
from twisted.web.server import NOT_DONE_YET

from up.version import VERSION
from up_ground.web.site import finish, refuse, send
from up_ground.web.tile_cache import Tile, TileCache

CONNECT_S = 5.0
FETCH_S = 15.0
MAX_TILE_BYTES = 1 << 20
MAX_PARALLEL = 4
MAX_WAITING = 256
MAX_ZOOM = 22
_PATH = re.compile(rb"/tiles/([0-9]{1,2})/([0-9]{1,8})/([0-9]{1,8})")
_SOURCE = re.compile(r"https?://[^\s\"'<>\\]{1,500}")
_KINDS = ((b"\x89PNG\r\n\x1a\n", b"image/png"), (b"\xff\xd8\xff", b"image/jpeg"))


def source_fault(source: str) -> str:
    """Return why an address is not a tile source; empty if it is one."""
    if not _SOURCE.fullmatch(source) or not source.isascii():
        return f"{source!r} is not an address that begins with http:// or https://"
    missing = [each for each in ("{z}", "{x}", "{y}") if each not in source]
    if missing:
        return f"{source!r} has no {' and no '.join(missing)}: write .../{{z}}/{{x}}/{{y}}.png"
    return ""


class TileSource:
    """Answers with a tile of the cache or of ``source``; few are fetched in parallel, each once.

    Disk access runs on other threads, so that it does not delay telemetry.
    """

    def __init__(self, reactor: Any, source: str, cache: TileCache) -> None:
        self._reactor = reactor
        self._source = source
        self._cache = cache
        pool = HTTPConnectionPool(reactor, persistent=False)
        self._agent = Agent(reactor, connectTimeout=CONNECT_S, pool=pool)
        self._requests: dict[Tile, list[Any]] = {}
        self._waiting: deque[Tile] = deque()
        self._busy: dict[Tile, Deferred[Any]] = {}

    def stop(self) -> None:
        self._waiting.clear()
        self._requests.clear()
        for each in list(self._busy.values()):
            each.cancel()

    def render(self, request: Any) -> Any:
        match = _PATH.fullmatch(request.path)
        z, x, y = (int(each) for each in match.groups()) if match else (99, 0, 0)
        if z > MAX_ZOOM or max(x, y) >= 1 << z:
            return refuse(request, http.NOT_FOUND, "unknown tile")
        tile = (z, x, y)
        if tile not in self._requests:
            if len(self._requests) >= MAX_WAITING:
                return refuse(request, http.SERVICE_UNAVAILABLE, "too many tiles are requested")
            self._requests[tile] = []
            # Before the queue: a kept tile does not wait for a source that does not answer.
            kept = self._in_thread(self._cache.get, *tile)
            kept.addCallbacks(self._on_cached, lambda _: self._on_cached(None, tile), (tile,))
        self._requests[tile].append(request)
        request.notifyFinish().addErrback(lambda _: self._discard(tile, request))
        return NOT_DONE_YET

    def _discard(self, tile: Tile, request: Any) -> None:
        requests = self._requests.get(tile, [])
        if request in requests:
            requests.remove(request)

    def _on_cached(self, content: bytes | None, tile: Tile) -> None:
        if content is not None and _kind(content):
            self._respond(content, tile)
        else:
            self._waiting.append(tile)
            self._fetch_next()

    def _fetch_next(self) -> None:
        while self._waiting and len(self._busy) < MAX_PARALLEL:
            tile = self._waiting.popleft()
            if not self._requests.get(tile):
                # The page that requested it has moved the map on.
                self._requests.pop(tile, None)
                continue
            fetched = Deferred.fromCoroutine(self._fetch(tile))
            self._busy[tile] = fetched
            fetched.addTimeout(FETCH_S, self._reactor)
            fetched.addCallbacks(self._cache_it, lambda _: None, callbackArgs=(tile,))
            fetched.addCallback(self._respond, tile)

    def _in_thread(self, call: Any, *arguments: Any) -> Deferred[Any]:
        return deferToThreadPool(self._reactor, self._reactor.getThreadPool(), call, *arguments)

    async def _fetch(self, tile: Tile) -> bytes | None:
        url = self._source
        for name, number in zip(("{z}", "{x}", "{y}"), tile, strict=True):
            url = url.replace(name, str(number))
        headers = Headers({"User-Agent": [f"up-ground/{VERSION} (ground station of Raspilot)"]})
        response: Any = await self._agent.request(b"GET", url.encode("ascii"), headers)
        body = _Body()
        response.deliverBody(body)
        content = await body.done
        return content if response.code == http.OK and _kind(content) else None

    def _cache_it(self, content: bytes | None, tile: Tile) -> Any:
        """Store the tile, then return it: the next request finds it in the cache."""
        if content is None:
            return None
        kept = self._in_thread(self._cache.put, *tile, content)
        return kept.addBoth(lambda _: content)

    def _respond(self, content: bytes | None, tile: Tile) -> None:
        self._busy.pop(tile, None)
        for request in self._requests.pop(tile, []):
            if content is None:
                text = "the map's source returned no tile"
                finish(request, refuse(request, http.BAD_GATEWAY, text))
            else:
                finish(request, _answer(request, content))
        self._fetch_next()


class _Body(Protocol):
    """Takes a bounded answer."""

    def __init__(self) -> None:
        self.done: Deferred[bytes] = Deferred(lambda _: self._abort())
        self._content = b""

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        self._content += data
        if len(self._content) > MAX_TILE_BYTES:
            self._abort()

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        is_whole = reason.check(ResponseDone) and len(self._content) <= MAX_TILE_BYTES
        if not self.done.called:
            self.done.callback(self._content if is_whole else b"")

    def _abort(self) -> None:
        transport: Any = self.transport
        transport.abortConnection()


def _kind(content: bytes) -> bytes:
    for mark, kind in _KINDS:
        if content.startswith(mark):
            return kind
    is_webp = content[:4] == b"RIFF" and content[8:12] == b"WEBP"
    return b"image/webp" if is_webp else b""


def _answer(request: Any, content: bytes) -> bytes:
    request.setHeader(b"content-type", _kind(content))
    tag = b'"%b"' % hashlib.sha256(content).hexdigest()[:24].encode("ascii")
    if request.setETag(tag) is http.CACHED:
        return b""
    return send(request, content)
