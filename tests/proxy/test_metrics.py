"""The metrics page."""

import re
import socket
import urllib.request

import pytest
from hypothesis import given
from hypothesis import strategies as st
from twisted.internet import task
from twisted.internet.error import ConnectionAborted
from twisted.internet.testing import StringTransport
from twisted.python.failure import Failure

from tests.proxy.program import Client, Program, accepted, until
from tests.support.scrape import probe
from up.system.metrics_page import (
    CONNECTION_LIMIT_S,
    CONTENT_TYPE,
    MAX_CONNECTIONS,
    MetricsFactory,
)
from up_proxy.metrics import page

LINE = re.compile(r'[a-z_]+(\{[a-z]+="(\\.|[^"\\\n])*"(,[a-z]+="(\\.|[^"\\\n])*")*\})? \S+')


def scrape(proxy):
    with urllib.request.urlopen(f"http://127.0.0.1:{proxy.metrics_port}/metrics") as answer:
        assert answer.headers["Content-Type"] == CONTENT_TYPE
        return answer.read().decode("utf-8")


def value(text, name):
    for line in text.splitlines():
        if line.startswith(name + " "):
            return float(line.rpartition(" ")[2])
    raise AssertionError(f"{name} is not in\n{text}")


@given(st.text())
def test_labels_are_escaped(text):
    shown = page([("m", "gauge", "Help.", [({"aircraft": text}, 1)])])
    line = shown.split("\n", 2)[2].removesuffix("\n")
    assert LINE.fullmatch(line)
    quoted = line[line.index('"') + 1 : line.rindex('"')]
    unescaped = re.sub(r"\\(.)", lambda m: {"n": "\n"}.get(m[1], m[1]), quoted)
    assert unescaped == text


def test_the_figures_of_the_page(tmp_path):
    with Program(tmp_path, "limits:\n  connections per side: 3\n") as proxy:
        air, _ = accepted(proxy.airborne_port, "UP1 aircraft=g\n")
        ground, _ = accepted(proxy.ground_port, "UP1 aircraft=g seat=command\n")
        listener, _ = accepted(proxy.ground_port, "UP1 aircraft=g seat=listen\n")
        listener.say("rejected\n")
        refused = Client(proxy.ground_port, "nonsense\n")
        assert "code=malformed" in refused.line()
        over = Client(proxy.ground_port)
        assert "code=full" in over.line()
        air.say("x" * 99 + "\n")
        ground.expect("xxx")
        shown = scrape(proxy)
        for line in shown.splitlines():
            assert line.startswith("#") or LINE.fullmatch(line), line
        assert value(shown, 'up_proxy_connections{side="airborne"}') == 1
        assert value(shown, 'up_proxy_connections{side="ground"}') == 3
        assert value(shown, 'up_proxy_aircraft_online{aircraft="g"}') == 1
        assert value(shown, 'up_proxy_aircraft_commanded{aircraft="g"}') == 1
        assert value(shown, 'up_proxy_aircraft_grounds{aircraft="g"}') == 2
        assert value(shown, 'up_proxy_aircraft_bytes_total{aircraft="g",side="airborne"}') == 100
        assert value(shown, 'up_proxy_bytes_total{side="airborne"}') == 100
        assert value(shown, "up_proxy_rejected_lines_total") == 1
        assert value(shown, 'up_proxy_refused_total{side="ground",code="malformed"}') == 1
        assert value(shown, 'up_proxy_over_limit_total{side="ground"}') == 1
        assert value(shown, "up_proxy_uptime_seconds") >= 0
        assert value(shown, "process_resident_memory_bytes") > 1_000_000
        assert value(shown, "up_proxy_loop_lag_seconds") >= 0
        for client in (air, ground, listener, refused, over):
            client.close()
        until(lambda: value(scrape(proxy), "up_proxy_aircraft") == 0, "no aircraft left")
        assert value(scrape(proxy), 'up_proxy_bytes_total{side="airborne"}') == 100


HEAD = b"GET /metrics HTTP/1.1\r\nHost: localhost\r\n"
HUGE = b"x" * 20_000_000


@pytest.mark.parametrize(
    ("request_bytes", "status"),
    [
        (HEAD + b"\r\n", 200),
        (HEAD.replace(b"localhost", b"127.0.0.1:9303") + b"\r\n", 200),
        (HEAD.replace(b"localhost", b"[::1]:9303") + b"\r\n", 200),
        (HEAD.replace(b"/metrics", b"/other") + b"\r\n", 404),
        (
            HEAD.replace(b"/metrics", b"/ready").replace(b"localhost", b"evil.example") + b"\r\n",
            421,
        ),
        (HEAD.replace(b"/metrics", b"/live").replace(b"GET", b"POST") + b"\r\n", 405),
        # DNS rebinding: the page of another site whose name points here.
        (HEAD.replace(b"localhost", b"evil.example") + b"\r\n", 421),
        (HEAD.replace(b"localhost", b"localhost.evil.example") + b"\r\n", 421),
        (HEAD + b"Host: evil.example\r\n\r\n", 421),
        (b"GET /metrics HTTP/1.0\r\n\r\n", 421),
        (HEAD.replace(b"GET", b"POST") + b"\r\n", 405),
        (b"\x00\r\n", 400),
        (b"three wrong words\r\n\r\n", 400),
        (b"\x00" * 10_000, 431),
        (b"GET /" + HUGE, 431),
        (HEAD + b"X: " + HUGE, 431),
        # The answer survives an unread request body.
        (HEAD + b"Content-Length: 20000000\r\n\r\n" + HUGE, 431),
        (HEAD + b"\r\n" + HUGE, 200),
        # One request a connection.
        (HEAD + b"\r\n" + HEAD.replace(b"/metrics", b"/other") + b"\r\n", 200),
    ],
)
def test_every_request_is_answered_once_and_the_connection_ends(local_page, request_bytes, status):
    with socket.create_connection(("127.0.0.1", local_page.metrics_port), timeout=4) as peer:
        peer.sendall(request_bytes)
        answer = b"".join(iter(lambda: peer.recv(65536), b""))
    assert re.findall(rb"^HTTP/1\.[01] (\d+)", answer, re.MULTILINE) == [b"%d" % status]
    assert (b"up_proxy_aircraft" in answer) == (status == 200)
    assert "Traceback" not in local_page.log


@pytest.fixture(scope="module")
def local_page(tmp_path_factory):
    with Program(tmp_path_factory.mktemp("page")) as proxy:
        yield proxy


def test_health_without_a_cluster(local_page):
    port = local_page.metrics_port
    assert probe(port, "live") == (200, "live")
    assert probe(port, "ready") == (200, "ready")


def test_a_slow_request_ends_after_the_limit_however_it_drips():
    clock = task.Clock()
    connection = MetricsFactory(clock, lambda: "").buildProtocol(None)
    transport = StringTransport()
    connection.makeConnection(transport)
    for byte in b"GET /metri":
        assert not transport.disconnecting
        connection.dataReceived(bytes([byte]))
        clock.advance(CONNECTION_LIMIT_S / 10)
    assert transport.disconnecting
    connection.connectionLost(Failure(ConnectionAborted()))
    assert not clock.getDelayedCalls()


def test_slow_connections_do_not_keep_another_one_out():
    factory = MetricsFactory(task.Clock(), lambda: "")
    transports = [StringTransport() for _ in range(2 * MAX_CONNECTIONS)]
    for transport in transports:
        factory.buildProtocol(None).makeConnection(transport)
    kept = [not transport.disconnecting for transport in transports]
    assert kept == MAX_CONNECTIONS * [False] + MAX_CONNECTIONS * [True]


def test_the_page_can_be_switched_off(tmp_path):
    with Program(tmp_path, "metrics: false\n") as proxy:
        proxy.end()
    assert proxy.metrics_port == 0
