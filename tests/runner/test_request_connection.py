"""A connection in virtual time, where silence and slowness are exact."""

import itertools
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from twisted.internet.address import IPv4Address
from twisted.internet.defer import Deferred, succeed
from twisted.internet.task import Clock
from twisted.internet.testing import StringTransport

from up.protocols.aircraft_sessions import Key
from up.protocols.pairing import Pairing
from up.protocols.runner_session import RunnerSession, body_of, to_line
from up_runner.config import Connections
from up_runner.request_gate import RequestGate
from up_runner.request_server import RequestServer
from up_runner.response import Response


class Line(StringTransport):
    """A transport that remembers how it ended."""

    aborted = half_closed = False

    def setTcpNoDelay(self, on):  # noqa: N802
        pass

    def abortConnection(self):  # noqa: N802
        self.aborted = True

    def loseWriteConnection(self):  # noqa: N802
        self.half_closed = True


class Port:
    """A request port with the test's answers, and one connection to it."""

    def __init__(self, at_once=True, accepts_plain=False, **limits):
        self.clock = Clock()
        self.asked = []
        self.waiting = []
        self.at_once = at_once
        self.gate = RequestGate("auto", accepts_plain=accepts_plain)
        self.server = RequestServer(
            self.clock,
            self.ask,
            lambda response, host: response.encode(host, None),
            Connections(**{"limit": 10, "address_limit": 10, **limits}),
            self.gate,
        )

    def ask(self, request):
        self.asked.append(request)
        if self.at_once:
            return succeed(Response(request.aircraft))
        self.waiting.append(Deferred())
        return self.waiting[-1]

    def connect(self, host="127.0.0.1"):
        connection = self.server.buildProtocol(IPv4Address("TCP", host, 1234))
        if connection is not None:
            connection.makeConnection(Line())
        return connection


def answers(connection):
    data = connection.transport.value()
    connection.transport.clear()
    return [json.loads(line) for line in data.splitlines()]


def instances(port):
    return [request.aircraft for request in port.asked]


def test_an_unfinished_first_line_is_a_legacy_client_after_one_second():
    port = Port()
    connection = port.connect()
    connection.dataReceived(b'{"aircraft"')
    port.clock.advance(0.9)
    assert port.asked == []
    connection.dataReceived(b":")
    port.clock.advance(0.9)
    assert port.asked == []
    port.clock.advance(0.2)
    assert instances(port) == ["default"] and len(answers(connection)) == 1
    connection.dataReceived(b"anything")
    assert instances(port) == ["default", "default"]


def test_after_a_request_an_unfinished_line_asks_for_nothing():
    port = Port()
    connection = port.connect()
    connection.dataReceived(b'{"aircraft": "a"}\n{"aircraft": "b"')
    for _ in range(9):
        port.clock.advance(1)
        connection.dataReceived(b" ")
    assert instances(port) == ["a"]
    port.clock.advance(1)
    assert answers(connection)[-1]["code"] == "unfinished"
    assert connection.transport.half_closed
    port.clock.advance(1)
    assert connection.transport.aborted and instances(port) == ["a"]


def test_a_byte_now_and_then_does_not_hold_a_connection():
    port = Port()
    connection = port.connect()
    for byte in b'{"aircraft": "a"' + b" " * 100:
        connection.dataReceived(bytes([byte]))
        port.clock.advance(0.9)
        if connection.transport.half_closed:
            break
    assert connection.transport.half_closed and port.clock.seconds() < 12


def test_nothing_is_read_while_a_request_is_handled():
    port = Port(at_once=False)
    connection = port.connect()
    connection.dataReceived(b'{"aircraft": "a"}\n{"aircraft": "b"}\n')
    assert instances(port) == ["a"] and connection.transport.producerState == "paused"
    port.clock.advance(3600)
    assert not connection.transport.aborted
    port.waiting[0].callback(Response("a"))
    assert instances(port) == ["a", "b"]
    port.waiting[1].callback(Response("b"))
    assert [answer["instance"] for answer in answers(connection)] == ["a", "b"]
    assert connection.transport.producerState == "producing"
    port.clock.advance(15)
    assert connection.transport.aborted


def test_a_client_that_does_not_read_is_not_read():
    port = Port()
    connection = port.connect()
    connection.pauseProducing()
    assert connection.transport.producerState == "paused"
    connection.resumeProducing()
    assert connection.transport.producerState == "producing"


def test_the_response_for_a_client_that_left_is_dropped():
    port = Port(at_once=False)
    connection = port.connect()
    connection.dataReceived(b"x")
    connection.connectionLost()
    port.waiting[0].callback(Response("default"))
    assert answers(connection) == [] and len(port.server) == 0
    port.server.close()
    assert port.clock.getDelayedCalls() == []


def test_a_bug_has_its_code():
    port = Port(at_once=False)
    connection = port.connect()
    connection.dataReceived(b"x")
    port.waiting[0].errback(ZeroDivisionError())
    assert answers(connection)[0]["code"] == "runner_bug"


@pytest.mark.parametrize(
    ("host", "in_"),
    [
        ("127.0.0.1", True),
        ("10.1.2.3", True),
        ("100.64.0.1", True),
        ("::ffff:192.168.0.1", True),
        ("fe80::1%eth0", True),
        ("203.0.113.9", False),
        ("::ffff:203.0.113.9", False),
        ("2001:db8::1", False),
    ],
)
def test_public_peers_are_rejected_on_connect(host, in_):
    assert (Port().connect(host) is not None) is in_
    assert Port(accepts_plain=True).connect(host) is not None
    if not in_:
        port = Port()
        for _ in range(100):
            port.connect(host)
        assert port.server.counts["public_address"] == 100
        port.server.close()


@pytest.mark.parametrize(
    ("security", "refusal", "codes"),
    [
        ("auto", "", {"203.0.113.9": "unprotected", "10.1.2.3": None}),
        ("require", "", {"203.0.113.9": "unprotected", "10.1.2.3": "unprotected"}),
        ("auto", "revoked", {"203.0.113.9": "closed", "10.1.2.3": None}),
        ("accept", "", {"203.0.113.9": "closed", "10.1.2.3": None}),
        ("off", "", {"203.0.113.9": "closed", "10.1.2.3": None}),
    ],
)
def test_who_needs_a_key(security, refusal, codes):
    port = Port()
    gate = port.server._gate = RequestGate(security, accepts_plain=False)
    gate.use({b"id": Key(b"id", b"", "phone", "pilot", refusal)})
    for host, code in codes.items():
        connection = port.connect(host)
        if connection is not None:
            connection.dataReceived(b"{}\n")
        assert ("closed" if connection is None else answers(connection)[0]["code"]) == code
    port.server.close()


def test_no_changed_byte_of_a_protected_request_is_accepted():
    port = Port()
    port.gate.use({bytes(8): Key(bytes(8), bytes(32), "phone", "pilot")})
    connection = port.connect("203.0.113.9")
    phone = RunnerSession(Pairing("glider-1", "00" * 8, "00" * 32, "pilot", "phone"))
    say = lambda line: connection.dataReceived(line) or answers(connection)[-1]  # noqa: E731
    line = phone.request(json.dumps(say(phone.hello())).encode(), b'{"aircraft": "glider-1"}')
    body = body_of(json.loads(line))
    for place, mask in itertools.product(range(len(body)), (1, 0x80, 0xFF)):
        changed = bytes([*body[:place], body[place] ^ mask, *body[place + 1 :]])
        assert say(to_line(changed))["code"] in ("forged", "malformed", "unknown_session")
        assert say(to_line(body[:place] or b"\x02"))["code"]
    assert port.asked == []
    answer = phone.result(json.dumps(say(line)).encode())
    assert json.loads(answer)["code"] is None and port.asked[0].key == "00" * 8
    # A protected request within another one names no aircraft.
    nested = to_line(phone._session.seal(line))
    assert json.loads(phone.result(json.dumps(say(nested)).encode()))["code"] == "malformed_request"
    assert len(port.asked) == 1


def test_an_ipv4_mapped_address_is_shown_as_ipv4():
    port = Port(accepts_plain=True)
    connection = port.connect("::ffff:203.0.113.9")
    connection.dataReceived(b"x")
    assert answers(connection)[0]["myAddress"] == "203.0.113.9"


@pytest.mark.parametrize(
    ("hosts", "is_one_source"),
    [
        (("fd00:0:0:1::1", "fd00:0:0:1:ffff::2"), True),
        (("fd00:0:0:1::1", "fd00:0:0:2::1"), False),
        (("::ffff:192.168.1.5", "192.168.1.5"), True),
        (("::ffff:192.168.1.5", "::ffff:192.168.1.6"), False),
    ],
)
def test_an_ipv6_network_is_one_source(hosts, is_one_source):
    port = Port(address_limit=1)
    first, second = (port.connect(host) for host in hosts)
    assert first is not None
    assert (second is None) == is_one_source
    assert port.server.counts["address_limit"] == is_one_source
    port.server.on_gone(first)
    # A source whose connections have ended may connect again.
    assert port.connect(hosts[0]) is not None


def test_the_connection_silent_for_longest_is_displaced():
    port = Port(limit=3)
    lines = []
    for _ in range(3):
        lines.append(port.connect())
        port.clock.advance(1)
    lines[0].dataReceived(b'{"action": "status"}\n')
    assert port.connect() is not None
    assert [line.transport.aborted for line in lines] == [False, True, False]
    assert len(port.server) == 3


lines_and_garbage = st.lists(
    st.sampled_from(
        [
            b'{"aircraft": "a"}\n',
            b'{"action": "status", "aircraft": "b"}\r\n',
            b"\n",
            b"{}}\n",
            b"nonsense\n",
            b'{"aircraft": "\xff"}\n',
        ]
    )
    | st.binary(max_size=30).map(lambda data: data.replace(b"\n", b"") + b"\n"),
    max_size=10,
)


@given(lines_and_garbage, st.data())
def test_the_cut_of_the_stream_changes_nothing(lines, data):
    stream = b'{"aircraft": "first"}\n' + b"".join(lines)
    whole, cut = Port(), Port()
    one, other = whole.connect(), cut.connect()
    one.dataReceived(stream)
    rest = stream
    while rest:
        size = data.draw(st.integers(1, len(rest)))
        other.dataReceived(rest[:size])
        rest = rest[size:]
    assert cut.asked == whole.asked
    assert answers(other) == answers(one)
    # One answer a line that is not empty.
    expected = sum(bool(line.strip()) for line in stream.split(b"\n"))
    assert whole.server.counts["malformed"] + len(whole.asked) == expected
