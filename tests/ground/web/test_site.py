"""The server's answers over HTTP, to a browser and to others."""

import socket
import struct

import pytest

from tests.ground.web.page import Page, Serve, get
from tests.support.reactor import run_in_reactor, until

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:;"
    " connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none';"
    " frame-ancestors 'none'"
)


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    # Port 1 has no listener: the page is served nevertheless.
    with Serve(folder, 1) as server:
        yield server


def check_headers(headers):
    assert headers["Content-Security-Policy"] == POLICY
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Referrer-Policy"] == "no-referrer"
    assert headers["Cache-Control"] == "no-cache"
    assert headers.get_all("Server") == ["up-ground"]


def raw(port, request):
    """Return the server's whole answer to these bytes, until it closes."""
    with socket.create_connection(("127.0.0.1", port), timeout=30) as peer:
        peer.sendall(request)
        said = b""
        try:
            while part := peer.recv(65536):
                said += part
        except ConnectionError:
            pass
    return said


def test_the_page_comes_with_its_headers(server):
    status, headers, body = get(server.port, "/")
    assert status == 200
    assert headers["Content-Type"] == "text/html; charset=utf-8"
    assert b"<html" in body
    check_headers(headers)


def test_a_file_that_is_known_is_not_sent_again(server):
    _, headers, body = get(server.port, "/js/main.js")
    assert headers["Content-Type"].startswith("text/javascript")
    status, again, nothing = get(server.port, "/js/main.js", **{"If-None-Match": headers["ETag"]})
    assert (status, nothing) == (304, b"")
    check_headers(again)
    status, headers, nothing = get(server.port, "/js/main.js", "HEAD")
    assert (status, nothing, int(headers["Content-Length"])) == (200, b"", len(body))


@pytest.mark.parametrize(
    "path",
    [
        "/nothing",
        "/js/",
        "/%2e%2e/page_link.py",
        "/js/main.js%00",
        "/tiles/1/0/0",
    ],
)
def test_there_is_nothing_else(server, path):
    status, headers, _ = get(server.port, path)
    assert status == 404
    check_headers(headers)


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE"])
def test_only_looking_is_allowed(server, method):
    status, headers, _ = get(server.port, "/", method)
    assert (status, headers["Allow"]) == (405, "GET, HEAD")
    check_headers(headers)


@pytest.mark.parametrize("host", ["evil.example", f"evil.example:{1}", ""])
def test_another_host_is_refused(server, host):
    for path in ("/", "/link"):
        status, headers, body = get(server.port, path, Host=host)
        assert status == 421
        assert b"html" not in body
        check_headers(headers)


def test_two_hosts_are_none(server):
    said = raw(
        server.port,
        b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n",
    )
    assert said.split(b"\r\n")[0].split()[1] in (b"400", b"421")


def test_a_link_of_another_site_is_refused(server):
    async def open_from(origin):
        page = await Page(server.port, origin=origin).open()
        is_open = page.is_open
        await page.leave()
        return is_open

    own = f"http://127.0.0.1:{server.port}"
    assert run_in_reactor(open_from, own)
    for origin in ("http://evil.example", "http://127.0.0.1:1", f"http://localhost:{server.port}"):
        assert not run_in_reactor(open_from, origin)


def test_the_links_address_is_no_page(server):
    status, headers, _ = get(server.port, "/link")
    assert status == 426
    check_headers(headers)


def test_a_message_too_long_is_closed_with_the_reason(server):
    async def send(length):
        page = Page(server.port)
        await page.hello(watch=None)
        head = '{"type": "ping", "ping": 1, "x": "'
        page.raw(head + "y" * (length - len(head) - 2) + '"}')
        return page

    async def talk():
        page = await send(1 << 20)
        assert (await page.next("pong"))["ping"] == 1
        await page.leave()
        for length in ((1 << 20) + 1, 3_000_000):
            page = await send(length)
            await until(lambda page=page: page.is_closed, what="the end")
            assert page.code == 4008
            assert page.of("pong") == []

    run_in_reactor(talk)


@pytest.mark.parametrize(
    ("request_bytes", "first"),
    [
        (b"GET * HTTP/1.1\r\nHost: 127.0.0.1\r\n", b"HTTP/1.1 404 Not Found"),
        (b"OPTIONS * HTTP/1.1\r\nHost: 127.0.0.1\r\n", b"HTTP/1.1 405 Method Not Allowed"),
        (b"GET / HTTP/1.1\r\nHost: evil.example\r\n", b"HTTP/1.1 421 Misdirected Request"),
        (b"GET /link HTTP/1.1\r\nHost: 127.0.0.1\r\n", b"HTTP/1.1 426 Upgrade Required"),
    ],
)
def test_refusals_have_the_standards_words_and_the_sites_headers(server, request_bytes, first):
    said = raw(server.port, request_bytes + b"Connection: close\r\n\r\n")
    lines = said.lower().split(b"\r\n")
    assert said.startswith(first + b"\r\n")
    assert [line for line in lines if line.startswith(b"server:")] == [b"server: up-ground"]
    assert f"content-security-policy: {POLICY}".lower().encode() in lines


@pytest.mark.parametrize(
    "request_bytes",
    [
        b"GET / HTTP/1.1\r\n" + b"X: " + b"y" * 70000,
        b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 600 + b"\r\n",
        b"\x00\x01\x02\r\n\r\n",
        b"GET\r\n\r\n",
    ],
)
def test_nonsense_is_cut_off(server, request_bytes):
    said = raw(server.port, request_bytes)
    assert b"200 OK" not in said
    assert b"Traceback" not in said
    assert b"twisted" not in said.lower()
    assert get(server.port, "/")[0] == 200


@pytest.mark.parametrize(
    "request_bytes",
    [
        b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 99999999\r\n\r\n" + b"x" * 4096,
        b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nxxxxx\r\n",
        b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 9\r\nExpect: 100-continue\r\n\r\n",
    ],
)
def test_a_request_with_a_body_is_answered_and_may_be_reset(server, request_bytes):
    said = raw(server.port, request_bytes)
    assert said.startswith(b"HTTP/1.1 413 ")
    assert said.count(b"HTTP/1.1") == 1
    with socket.create_connection(("127.0.0.1", server.port)) as peer:
        peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        peer.sendall(request_bytes)
    assert get(server.port, "/")[0] == 200
    assert server.stderr == ""
