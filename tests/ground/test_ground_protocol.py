import socket

from twisted.internet.error import ConnectionLost
from twisted.internet.task import Clock
from twisted.internet.testing import StringTransportWithDisconnection
from twisted.python.failure import Failure

from up_ground.ground_protocol import GroundProtocol


class Transport(StringTransportWithDisconnection):
    """Takes the socket options on its own socket."""

    def __init__(self):
        super().__init__()
        self.socket = socket.socket()

    def getHandle(self):  # noqa: N802 - Twisted's name
        return self.socket

    def setTcpNoDelay(self, on):  # noqa: N802
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, on)

    def setTcpKeepAlive(self, on):  # noqa: N802
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, on)

    def abortConnection(self):  # noqa: N802
        self.loseConnection()


class Owner:
    def __init__(self):
        self.lines, self.controls, self.lost, self.made = [], [], [], 0

    def on_made(self, connection):
        self.made += 1

    def on_line(self, connection, line):
        self.lines.append(line)

    def on_control(self, connection, line):
        self.controls.append(line)

    def on_lost(self, connection, reason, code):
        self.lost.append(code)


class Bench:
    def __init__(self, hello=b"UP1 aircraft=default seat=listen\n"):
        self.clock, self.owner, self.transport = Clock(), Owner(), Transport()
        self.protocol = GroundProtocol(self.clock, self.owner, hello)
        self.transport.protocol = self.protocol
        self.protocol.makeConnection(self.transport)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if not self.owner.lost:
            self.transport.loseConnection()
        assert self.clock.getDelayedCalls() == []
        self.transport.socket.close()

    def said(self):
        value = self.transport.value()
        self.transport.clear()
        return value


def test_the_hello_is_first_and_the_heartbeat_fills_silence():
    with Bench() as bench:
        assert bench.said() == b"UP1 aircraft=default seat=listen\n"
        bench.protocol.accept()
        for _ in range(3):
            bench.clock.advance(1.0)
            assert bench.said() == b"\n"
        bench.clock.advance(0.6)
        bench.protocol.send(b"{}\n")
        assert bench.said() == b"{}\n"
        bench.clock.advance(0.6)
        assert bench.said() == b""
        bench.clock.advance(0.4)
        assert bench.said() == b"\n"


def test_without_a_hello_nothing_is_said_by_itself():
    with Bench(hello=None) as bench:
        bench.clock.advance(100)
        assert bench.said() == b""
        assert bench.owner.made == 1


def test_a_hello_without_an_answer_is_given_up():
    with Bench() as bench:
        bench.clock.advance(4.9)
        assert bench.owner.lost == []
        bench.clock.advance(0.2)
        assert bench.owner.lost == ["no_hello_answer"]


def test_lines_of_the_proxy_and_of_the_aircraft_are_kept_apart():
    with Bench() as bench:
        bench.protocol.dataReceived(b'UP1 ok\r\n{"a": 1}\n\n{"UP1 ": 2}\nUP1x\nUP1 seat listen\n')
        assert bench.owner.controls == [b"UP1 ok", b"UP1 seat listen"]
        assert bench.owner.lines == [b'{"a": 1}', b'{"UP1 ": 2}', b"UP1x"]


def test_half_a_line_dies_with_its_connection():
    with Bench() as bench:
        bench.protocol.dataReceived(b'{"half": ')
        bench.protocol.connectionLost(Failure(ConnectionLost()))
        assert bench.owner.lines == []
        assert not bench.protocol.send(b"late\n")
    with Bench() as bench:
        bench.protocol.dataReceived(b"1}\n")
        assert bench.owner.lines == [b"1}"]


def test_nothing_is_handed_on_after_giving_up():
    with Bench() as bench:
        bench.owner.on_line = lambda connection, line: connection.abort("too many", "enough")
        bench.protocol.dataReceived(b"1\n2\n")
        assert bench.owner.lost == ["enough"]


def test_lines_that_are_too_long_are_dropped_and_counted():
    with Bench() as bench:
        bench.protocol.dataReceived(b"x" * 20000 + b"\nshort\n")
        assert bench.owner.lines == [b"short"]
        assert bench.protocol.dropped_too_long == 1
