"""Which connections the server keeps, by their own clock and over real sockets."""

import json
import socket

import pytest
from twisted.internet.address import IPv4Address, IPv6Address
from twisted.internet.protocol import Factory, Protocol
from twisted.internet.task import Clock
from twisted.internet.testing import StringTransportWithDisconnection
from twisted.internet.threads import deferToThread

from tests.ground.web.page import Page, Serve, sign_in
from tests.support.reactor import run_in_reactor, until
from up_ground.web.access import Access
from up_ground.web.connections import (
    HEADER_S,
    HTTP_LIMIT_S,
    PER_PEER_LIMIT,
    WAITING_LIMIT,
    Connections,
)
from up_ground.web.server import STATIC
from up_ground.web.site import GroundResource, make_site
from up_ground.web.static_files import StaticFiles

KEY = "the-right-key"
FAIR = WAITING_LIMIT // 4


class Bench:
    def __init__(self, clock, wrapped):
        self.clock = clock
        self.connections = Connections(clock, wrapped)

    def open(self, host="192.0.2.1"):
        kind = IPv6Address if ":" in host else IPv4Address
        connection = self.connections.buildProtocol(kind("TCP", host, 1))
        transport = StringTransportWithDisconnection()
        transport.protocol = connection
        connection.makeConnection(transport)
        return connection

    def many(self, count, *hosts):
        return [self.open(host) for _ in range(count) for host in hosts]


@pytest.fixture
def bench():
    return Bench(Clock(), Factory.forProtocol(Protocol))


def is_open(connection):
    return connection.transport.connected


def test_a_first_request_that_dribbles_is_closed(bench):
    slow, quick = bench.open(), bench.open()
    quick.on_request()
    for _ in range(10):
        slow.dataReceived(b"X: y\r\n")
        bench.clock.advance(HEADER_S / 10)
    assert (is_open(slow), is_open(quick)) == (False, True)
    bench.clock.advance(HTTP_LIMIT_S - HEADER_S)
    assert not is_open(quick)


def test_a_whole_request_of_the_site_is_a_first_one():
    clock = Clock()
    resource = GroundResource(Access(), StaticFiles(STATIC), None)
    bench = Bench(clock, make_site(clock, resource))
    connection = bench.open()
    connection.dataReceived(b"GET /nothing HTTP/1.1\r\nHost: 127.0.0.1\r\n")
    assert not connection.has_asked
    connection.dataReceived(b"\r\n")
    assert connection.transport.value().startswith(b"HTTP/1.1 404 ")
    clock.advance(HEADER_S)
    assert is_open(connection)
    connection.transport.loseConnection()
    assert clock.getDelayedCalls() == []


def test_requests_do_not_put_off_the_end(bench):
    connection = bench.open()
    for _ in range(12):
        connection.on_request()
        bench.clock.advance(HTTP_LIMIT_S / 12)
    assert not is_open(connection)


def test_of_a_crowd_at_one_address_the_oldest_without_a_request_leaves(bench):
    first, second, *rest = bench.many(PER_PEER_LIMIT, "192.0.2.1")
    first.on_request()
    other = bench.open("192.0.2.2")
    assert all(map(is_open, (first, second, other, *rest)))
    newest = bench.open("192.0.2.1")
    assert not is_open(second)
    assert all(map(is_open, (first, other, newest, *rest)))


def test_a_network_of_ipv6_is_one_address(bench):
    opened = [bench.open(f"2001:db8::{number + 1:x}") for number in range(PER_PEER_LIMIT + 1)]
    assert [is_open(each) for each in opened] == [False] + [True] * PER_PEER_LIMIT


def test_of_a_full_house_the_greediest_address_loses_one(bench):
    fair = bench.many(FAIR, "192.0.2.2", "192.0.2.3")
    greedy = bench.many(WAITING_LIMIT - 2 * FAIR - 20, "192.0.2.1")
    assert len(greedy) > FAIR
    more = bench.many(20, "192.0.2.4")
    newcomer = bench.open("192.0.2.5")
    assert not is_open(greedy[0])
    assert all(map(is_open, (*fair, *greedy[1:], *more, newcomer)))


def test_a_welcomed_page_neither_leaves_nor_counts(bench):
    page, *others = bench.many(PER_PEER_LIMIT, "192.0.2.1")
    page.admit()
    assert is_open(bench.open("192.0.2.1"))
    assert all(map(is_open, others))
    bench.many(PER_PEER_LIMIT, "192.0.2.1")
    assert is_open(page)


def test_what_is_closed_is_forgotten(bench):
    for connection in bench.many(10, "192.0.2.1", "192.0.2.2"):
        connection.connectionLost()
    assert bench.connections._waiting == {}
    assert bench.clock.getDelayedCalls() == []


def test_slow_connections_keep_no_page_with_the_key_out(tmp_path):
    slow = []

    async def come():
        status, cookie = await deferToThread(sign_in, server.port, KEY)
        assert status == 204
        page = Page(server.port, cookie=cookie)
        welcome = await page.hello("pilot", watch=None)
        assert welcome["may_control"]
        await page.leave()

    with Serve(tmp_path, 1, "--key", KEY) as server:
        try:
            for number in range(3 * PER_PEER_LIMIT):
                slow.append(
                    socket.create_connection(
                        ("127.0.0.1", server.port), 30, (f"127.0.0.{number % 3 + 2}", 0)
                    )
                )
                slow[-1].sendall(b"GET / HTTP/1.1\r\n")
            run_in_reactor(come)
        finally:
            for each in slow:
                each.close()


def test_a_page_that_is_not_welcome_yet_says_little(tmp_path):
    async def talk():
        page = Page(server.port)
        await page.open()
        page.raw(json.dumps({"type": "hello", "name": "x" * 1024}))
        await until(lambda: page.is_closed, what="the end")
        assert page.code == 4008

    with Serve(tmp_path, 1) as server:
        run_in_reactor(talk)
