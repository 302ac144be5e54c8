"""The map's pictures: fetched once, cached, and never requested elsewhere by the page."""

import hashlib
import os
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest
from twisted.web.server import NOT_DONE_YET
from twisted.web.test.requesthelper import DummyRequest

from tests.ground.web.page import Page, Serve, get
from tests.support.reactor import reactor, run_in_reactor
from tests.support.reactor import until as soon
from up_ground.web.site import HEADERS
from up_ground.web.tile_cache import TileCache
from up_ground.web.tiles import MAX_PARALLEL, TileSource

PNG = b"\x89PNG\r\n\x1a\n" + bytes(500)


class Source:
    """A server of tiles; `asked` has the requested paths, `agents` the user agents."""

    def __init__(self):
        self.asked, self.agents, self.body, self.status = [], set(), PNG, 200
        self.hold = None
        source = self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self):
                source.asked.append(self.path)
                source.agents.add(self.headers["User-Agent"])
                if source.hold is not None:
                    source.hold.wait(30)
                self.send_response(source.status)
                self.send_header("Content-Length", str(len(source.body)))
                self.end_headers()
                self.wfile.write(source.body)

            def log_message(self, *_):
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.thread = threading.Thread(target=self.server.serve_forever, daemon=True)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.server.shutdown()
        self.server.server_close()
        self.thread.join(30)

    @property
    def url(self):
        return f"http://127.0.0.1:{self.server.server_port}/t/{{z}}/{{x}}/{{y}}.png"


@pytest.fixture
def source():
    with Source() as source:
        yield source


@pytest.fixture
def server(source, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    with Serve(tmp_path, 1, "--tiles", source.url, "--attribution", "somebody's map") as server:
        yield server


def test_a_tile_is_fetched_once_and_kept(server, source):
    for _ in range(3):
        status, headers, body = get(server.port, "/tiles/3/4/5")
        assert (status, headers["Content-Type"], body) == (200, "image/png", PNG)
        assert headers["Content-Security-Policy"] == HEADERS[b"content-security-policy"].decode()
    assert source.asked == ["/t/3/4/5.png"]
    assert all(agent.startswith("up-ground/") for agent in source.agents)
    status, _, body = get(server.port, "/tiles/3/4/5", **{"If-None-Match": headers["ETag"]})
    assert (status, body) == (304, b"")


@pytest.mark.parametrize(
    "path",
    ["/tiles/3/8/0", "/tiles/3/0/8", "/tiles/99/0/0", "/tiles/3/-1/0", "/tiles/3/4", "/tiles/a/b/c",
     "/tiles/3/4/5.png", "/tiles/../../etc/passwd"],
)  # fmt: skip
def test_what_is_no_tile_is_not_asked_for(server, source, path):
    assert get(server.port, path)[0] == 404
    assert source.asked == []


def test_what_is_no_picture_is_not_passed_on(server, source):
    source.body = b"<html>sorry</html>"
    assert get(server.port, "/tiles/3/4/5")[0] == 502
    source.body, source.status = PNG, 404
    assert get(server.port, "/tiles/3/4/5")[0] == 502
    source.status, source.body = 200, PNG + bytes(2_000_000)
    assert get(server.port, "/tiles/3/4/5")[0] == 502
    source.body = PNG
    assert get(server.port, "/tiles/3/4/5")[0] == 200


def test_the_page_hears_of_the_map(server):
    async def look():
        page = Page(server.port)
        welcome = await page.hello(watch=None)
        assert welcome["tiles"] == {"url": "/tiles/{z}/{x}/{y}", "attribution": "somebody's map"}
        await page.leave()

    run_in_reactor(look)


def test_the_cache_is_bounded_and_keeps_what_is_used(tmp_path):
    cache = TileCache(tmp_path, "http://a/", limit=10_000)
    for number in range(50):
        cache.put(10, number, 0, bytes(1000))
        if number:
            assert cache.get(10, 0, 0) is not None
    kept = list(tmp_path.glob("*/*/*/*"))
    assert 5 <= len(kept) <= 10
    assert TileCache(tmp_path, "http://b/").get(10, 0, 0) is None
    # The next run finds them, and the oldest go first again.
    for age, path in enumerate(sorted(kept)):
        os.utime(path, ns=(10**18 - age * 10**9,) * 2)
    again = TileCache(tmp_path, "http://a/", limit=10_000)
    again.put(10, 100, 0, bytes(1000))
    assert not max(kept).exists()
    assert again.get(10, 0, 0) is not None
    few = TileCache(tmp_path, "http://a/", tiles_limit=3)
    few.put(10, 101, 0, bytes(10))
    assert len(list(tmp_path.glob("*/*/*/*"))) == 3
    few.put(10, 101, 0, bytes(10))
    assert len(list(tmp_path.glob("*/*/*/*"))) == 3


@pytest.mark.parametrize("left", [0, 10, 32, 40, 400])
def test_what_a_power_cut_left_is_no_tile(tmp_path, left):
    TileCache(tmp_path, "http://a/").put(1, 1, 1, PNG)
    (path,) = tmp_path.glob("*/*/*/*.tile")
    path.write_bytes(path.read_bytes()[:left])
    stray = path.with_suffix(".0a1b2c3d")
    stray.write_bytes(b"half")
    cache = TileCache(tmp_path, "http://a/")
    assert cache.get(1, 1, 1) is None
    cache.put(1, 1, 1, PNG)
    assert cache.get(1, 1, 1) == PNG
    assert not stray.exists()


def test_an_empty_file_of_the_cache_is_fetched_anew(server, source, tmp_path):
    assert get(server.port, "/tiles/3/4/5")[0] == 200
    (path,) = (tmp_path / "cache").glob("up-ground/tiles/*/3/4/5.tile")
    for content in (b"", hashlib.sha256(b"<html>").digest() + b"<html>"):
        path.write_bytes(content)
        status, headers, body = get(server.port, "/tiles/3/4/5")
        assert (status, headers["Content-Type"], body) == (200, "image/png", PNG)
    assert len(source.asked) == 3


class SlowCache:
    """A cache whose disk stands still until `go_on`."""

    def __init__(self):
        self.go_on, self.calls = threading.Event(), []

    def get(self, *tile):
        return self._wait("get")

    def put(self, *tile_and_content):
        return self._wait("put")

    def _wait(self, name):
        self.calls.append((name, threading.get_ident()))
        self.go_on.wait(30)


def test_a_disk_that_stands_still_holds_nothing_else_up(source):
    cache = SlowCache()

    async def look():
        tiles = TileSource(reactor, source.url, cache)
        requests = [DummyRequest([b""]) for _ in range(2)]
        for number, request in enumerate(requests):
            request.path, request.setETag = b"/tiles/3/4/%d" % number, lambda tag: None
            assert tiles.render(request) is NOT_DONE_YET
        # This thread continues while two of the cache's wait.
        await soon(lambda: len(cache.calls) == 2, what="the cache's calls")
        assert source.asked == []
        cache.go_on.set()
        await soon(lambda: all(request.finished for request in requests), what="the tiles")
        assert b"".join(requests[0].written) == PNG
        tiles.stop()

    run_in_reactor(look)
    assert sorted(name for name, _ in cache.calls) == ["get", "get", "put", "put"]
    assert threading.get_ident() not in {thread for _, thread in cache.calls}


def test_a_kept_tile_does_not_wait_for_a_source_that_does_not_answer(source, tmp_path):
    cache = TileCache(tmp_path, source.url)
    cache.put(3, 4, 5, PNG)
    held = threading.Event()
    source.hold = held

    async def look():
        tiles = TileSource(reactor, source.url, cache)
        missing = [DummyRequest([b""]) for _ in range(3 * MAX_PARALLEL)]
        for number, request in enumerate(missing):
            request.path, request.setETag = b"/tiles/5/1/%d" % number, lambda tag: None
            tiles.render(request)
        await soon(lambda: len(source.asked) == MAX_PARALLEL, what="the source's first")
        kept = DummyRequest([b""])
        kept.path, kept.setETag = b"/tiles/3/4/5", lambda tag: None
        tiles.render(kept)
        await soon(lambda: kept.finished, what="the kept tile")
        assert b"".join(kept.written) == PNG
        assert len(source.asked) == MAX_PARALLEL
        held.set()
        await soon(lambda: all(each.finished for each in missing), what="the others")
        tiles.stop()

    run_in_reactor(look)


def test_a_cache_that_cannot_be_written_is_none(tmp_path):
    (tmp_path / "file").write_text("")
    cache = TileCache(tmp_path / "file", "http://a/")
    cache.put(1, 1, 1, PNG)
    assert cache.get(1, 1, 1) is None
