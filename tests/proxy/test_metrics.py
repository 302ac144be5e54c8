"""The metrics page."""

import re
import socket
import urllib.error
import urllib.request

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.proxy.program import Client, Program, accepted, until
from up_proxy.metrics_page import CONTENT_TYPE, Metric, Sample, render

LINE = re.compile(r'[a-z_]+(\{[a-z]+="(\\.|[^"\\\n])*"(,[a-z]+="(\\.|[^"\\\n])*")*\})? \S+')


def scrape(proxy):
    with urllib.request.urlopen(f"http://127.0.0.1:{proxy.metrics_port}/metrics") as answer:
        assert answer.headers["Content-Type"] == CONTENT_TYPE
        return answer.read().decode("utf-8")


def value(page, name):
    for line in page.splitlines():
        if line.startswith(name + " "):
            return float(line.rpartition(" ")[2])
    raise AssertionError(f"{name} is not in\n{page}")


@given(st.text())
def test_labels_are_escaped(text):
    page = render([Metric("m", "gauge", "Help.", (Sample(1, {"aircraft": text}),))])
    line = page.split("\n", 2)[2].removesuffix("\n")
    assert LINE.fullmatch(line)
    quoted = line[line.index('"') + 1 : line.rindex('"')]
    unescaped = re.sub(r"\\(.)", lambda m: {"n": "\n"}.get(m[1], m[1]), quoted)
    assert unescaped == text


def test_what_the_page_tells(tmp_path):
    with Program(tmp_path, "limits:\n  connections per side: 3\n") as proxy:
        air, _ = accepted(proxy.airborne_port, "UP1 aircraft=g\n")
        ground, _ = accepted(proxy.ground_port, "UP1 aircraft=g seat=command\n")
        listener, _ = accepted(proxy.ground_port, "UP1 aircraft=g seat=listen\n")
        listener.say("unheard\n")
        refused = Client(proxy.ground_port, "nonsense\n")
        assert "code=malformed" in refused.line()
        over = Client(proxy.ground_port)
        assert "code=full" in over.line()
        air.say("x" * 99 + "\n")
        ground.expect("xxx")
        page = scrape(proxy)
        for line in page.splitlines():
            assert line.startswith("#") or LINE.fullmatch(line), line
        assert value(page, 'up_proxy_connections{side="airborne"}') == 1
        assert value(page, 'up_proxy_connections{side="ground"}') == 3
        assert value(page, 'up_proxy_aircraft_online{aircraft="g"}') == 1
        assert value(page, 'up_proxy_aircraft_commanded{aircraft="g"}') == 1
        assert value(page, 'up_proxy_aircraft_grounds{aircraft="g"}') == 2
        assert value(page, 'up_proxy_aircraft_bytes_total{aircraft="g",side="airborne"}') == 100
        assert value(page, 'up_proxy_bytes_total{side="airborne"}') == 100
        assert value(page, "up_proxy_unheard_lines_total") == 1
        assert value(page, 'up_proxy_refused_total{side="ground",code="malformed"}') == 1
        assert value(page, 'up_proxy_over_limit_total{side="ground"}') == 1
        assert value(page, "up_proxy_uptime_seconds") >= 0
        assert value(page, "process_resident_memory_bytes") > 1_000_000
        assert value(page, "up_proxy_loop_lag_seconds") >= 0
        for client in (air, ground, listener, refused, over):
            client.close()
        until(lambda: value(scrape(proxy), "up_proxy_aircraft") == 0, "everybody forgotten")
        assert value(scrape(proxy), 'up_proxy_bytes_total{side="airborne"}') == 100


def test_the_page_is_local_and_bears_nonsense(tmp_path):
    with Program(tmp_path) as proxy:
        with pytest.raises(urllib.error.HTTPError, match="404") as missing:
            urllib.request.urlopen(f"http://127.0.0.1:{proxy.metrics_port}/other")
        missing.value.close()
        for data in (b"\x00" * 10_000, b"GET /metrics\r\n\r\n", b"POST /metrics HTTP/1.1\r\n\r\n"):
            with socket.create_connection(("127.0.0.1", proxy.metrics_port)) as peer:
                peer.sendall(data)
                peer.shutdown(socket.SHUT_WR)
                try:
                    while peer.recv(4096):
                        pass
                except ConnectionError:
                    continue
        assert value(scrape(proxy), "up_proxy_aircraft") == 0
        proxy.end()
    assert "Traceback" not in proxy.log


def test_the_page_can_be_switched_off(tmp_path):
    with Program(tmp_path, "metrics: false\n") as proxy:
        assert "metrics" not in proxy.log
        proxy.end()
