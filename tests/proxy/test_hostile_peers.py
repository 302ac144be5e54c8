"""Peers that idle, flood, stall and lie, beside a pair that must not notice."""

import random
import socket
import threading

import pytest

from tests.proxy.program import Client, Program, accepted, until
from tests.proxy.test_metrics import scrape, value
from tests.up.protocols.test_proxy_lines import mutated

LIMITS = (
    "limits:\n  connections per side: 1500\n  connections per address: 1500\n"
    "  connections per second: 100000\n"
)
GROWTH_BYTES = 24_000_000


@pytest.fixture
def proxy(tmp_path):
    with Program(tmp_path, LIMITS) as proxy:
        yield proxy
        assert proxy.end() == 0
    assert "Traceback" not in proxy.log


class GoodPair:
    """An aircraft and its ground that relay to and fro; every line must come, in order."""

    def __init__(self, proxy):
        self.air, _ = accepted(proxy.airborne_port, "UP1 aircraft=good\n")
        self.ground, _ = accepted(proxy.ground_port, "UP1 aircraft=good seat=command\n")
        self.count = 0

    def round_trips(self, number):
        for _ in range(number):
            self.count += 1
            self.air.say(f"telemetry {self.count}\n")
            assert self.ground.expect("telemetry") == f"telemetry {self.count}\n"
            self.ground.say(f"command {self.count}\n")
            assert self.air.expect("command") == f"command {self.count}\n"

    def close(self):
        self.air.close()
        self.ground.close()


@pytest.fixture
def pair(proxy):
    pair = GoodPair(proxy)
    yield pair
    pair.close()


def test_a_thousand_idle_sockets(proxy, pair):
    before = proxy.rss_bytes()
    ports = (proxy.ground_port, proxy.airborne_port)
    idle = [socket.create_connection(("127.0.0.1", port)) for port in ports for _ in range(500)]
    pair.round_trips(100)
    assert proxy.rss_bytes() - before < GROWTH_BYTES
    for each in idle:
        each.close()

    def all_gone():
        pair.round_trips(1)
        page = scrape(proxy)
        sides = ("airborne", "ground")
        return all(value(page, f'up_proxy_connections{{side="{side}"}}') == 1 for side in sides)

    until(all_gone, "the end of every idle socket", deadline_s=60)


@pytest.mark.parametrize("start", [b"", b"{", b"UP1 aircraft=liar\n", b"UP1 aircraft=good\n"])
@pytest.mark.parametrize("side", ["airborne", "ground"])
def test_a_line_of_a_gigabyte(proxy, pair, side, start):
    before = proxy.rss_bytes()
    port = proxy.airborne_port if side == "airborne" else proxy.ground_port
    sent = 0
    with socket.create_connection(("127.0.0.1", port)) as peer:
        peer.settimeout(30)
        chunk = b"x" * 1_000_000
        try:
            peer.sendall(start)
            while sent < 1_000_000_000:
                peer.sendall(chunk)
                sent += len(chunk)
        except ConnectionError:
            pass
    assert sent < 1_000_000_000
    pair.round_trips(10)
    assert proxy.rss_bytes() - before < GROWTH_BYTES


def test_readers_that_stall(proxy, pair):
    stalled = [accepted(proxy.ground_port, "UP1 aircraft=good seat=listen\n")[0] for _ in range(20)]
    before = proxy.rss_bytes()
    line = "x" * 1000 + "\n"
    for _ in range(300):
        for _ in range(50):
            pair.air.say(line)
        for _ in range(50):
            pair.ground.expect("xxx")
        pair.round_trips(1)
    assert value(scrape(proxy), "up_proxy_dropped_lines_total") > 0
    assert proxy.rss_bytes() - before < GROWTH_BYTES
    for client in stalled:
        client.close()


def test_listeners_that_flood(proxy, pair):
    stop = threading.Event()

    def flood():
        client, _ = accepted(proxy.ground_port, "UP1 aircraft=good seat=command\n")
        data = (b"UP1 seat request\n" + b"x" * 999 + b"\n") * 50
        while not stop.is_set():
            client.say(data)
        client.close()

    floods = [threading.Thread(target=flood) for _ in range(3)]
    for each in floods:
        each.start()
    try:
        pair.round_trips(200)
    finally:
        stop.set()
        for each in floods:
            each.join()
    assert value(scrape(proxy), "up_proxy_rejected_lines_total") > 0


def test_mutated_hellos_over_real_sockets(proxy, pair):
    chance = random.Random(7)
    for number in range(3000):
        with socket.create_connection(("127.0.0.1", proxy.ground_port)) as peer:
            peer.sendall(mutated(chance))
            if number % 3 == 0:
                peer.shutdown(socket.SHUT_WR)
        if number % 100 == 0:
            pair.round_trips(1)
    pair.round_trips(10)


def test_the_limit_of_an_address_is_checked_on_connect(tmp_path):
    with Program(tmp_path, "limits:\n  connections per address: 2\n") as proxy:
        clients = [Client(proxy.ground_port) for _ in range(2)]
        with Client(proxy.ground_port) as third:
            assert third.line().startswith("UP1 error code=full ")
            assert third.line() == ""
        clients.pop().close()

        def admitted():
            with Client(proxy.ground_port, "UP1 aircraft=a seat=listen\n") as client:
                return client.line().startswith("UP1 ok")

        until(admitted, "room after one has left")
        clients.pop().close()
