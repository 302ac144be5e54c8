"""The map's pictures: fetched once, kept, and never asked for by the page elsewhere."""

import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest

from tests.ground.web.page import Page, Serve, get
from tests.support.reactor import run_in_reactor
from up_ground.web.site import HEADERS
from up_ground.web.tile_cache import TileCache

PNG = b"\x89PNG\r\n\x1a\n" + bytes(500)


class Source:
    """A server of tiles; `asked` has the paths, `agents` who asked."""

    def __init__(self):
        self.asked, self.agents, self.body, self.status = [], set(), PNG, 200
        source = self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self):
                source.asked.append(self.path)
                source.agents.add(self.headers["User-Agent"])
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
    kept = [path for path in tmp_path.glob("*/*/*/*")]
    assert 5 <= len(kept) <= 10
    assert TileCache(tmp_path, "http://b/").get(10, 0, 0) is None


def test_a_cache_that_cannot_be_written_is_none(tmp_path):
    (tmp_path / "file").write_text("")
    cache = TileCache(tmp_path / "file", "http://a/")
    cache.put(1, 1, 1, PNG)
    assert cache.get(1, 1, 1) is None
