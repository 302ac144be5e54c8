import json
import socket

from twisted.internet.protocol import Factory
from twisted.internet.task import Clock

from tests.support.reactor import reactor, run_in_reactor, sleep, until
from tests.support.transport import Transport
from up.protocols.general_message import encode
from up.protocols.general_message_link import (
    MAX_BURST,
    MAX_MESSAGES_HZ,
    GeneralMessageProtocol,
)


class Listener:
    """A real port whose links record their messages."""

    def __init__(self, **options):
        self.links = []
        self.messages = []
        self.faults = []
        self.connected = []
        self.lost = []
        self.options = options
        self.port = reactor.listenTCP(0, Factory.forProtocol(self.make), interface="127.0.0.1")
        self.number = self.port.getHost().port

    def make(self):
        link = GeneralMessageProtocol(
            reactor,
            on_message=lambda link, message: self.messages.append((link, message)),
            on_malformed=lambda link, fault: self.faults.append((link, fault)),
            on_connected=self.connected.append,
            on_lost=lambda link, why: self.lost.append((link, why)),
            **self.options,
        )
        self.links.append(link)
        return link

    async def client(self, receive_buffer=None):
        """Return a blocking socket whose link is connected."""
        before = len(self.connected)
        client = socket.socket()
        if receive_buffer:
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        client.connect(("127.0.0.1", self.number))
        await until(lambda: len(self.connected) > before)
        return client

    async def close(self):
        for link in self.links:
            link.abort()
        await until(lambda: len(self.lost) == len(self.connected))
        await self.port.stopListening()


def with_listener(scenario, **options):
    async def run():
        listener = Listener(**options)
        try:
            await scenario(listener)
        finally:
            await listener.close()

    run_in_reactor(run)


async def receive_all(client, is_complete):
    """Read without blocking the reactor until `is_complete(received)` or the end."""
    client.setblocking(False)
    received = bytearray()

    def read():
        try:
            piece = client.recv(65536)
        except BlockingIOError:
            return is_complete(received)
        received.extend(piece)
        return not piece or is_complete(received)

    await until(read, what="the rest of the sent lines")
    return bytes(received)


def test_messages_pass_both_ways():
    async def scenario(listener):
        with await listener.client() as client:
            client.sendall(b'{"name": "up.arm", "id": 1}\r\n\n\n{"name": "up.dis')
            await until(lambda: listener.messages)
            client.sendall(b'arm"}\n')
            await until(lambda: len(listener.messages) == 2)
            assert [message.name for _, message in listener.messages] == ["up.arm", "up.disarm"]
            link = listener.links[0]
            assert link.peer == f"127.0.0.1:{client.getsockname()[1]}"
            assert link.send(encode("up.ack", {"id": "1"}))
            assert link.send_newest(encode("up.telemetry.update", {}))
            received = await receive_all(client, lambda data: data.count(b"\n") == 2)
            names = [json.loads(line)["name"] for line in received.splitlines()]
            assert names == ["up.ack", "up.telemetry.update"]
            assert not listener.faults

    with_listener(scenario)


def test_what_is_malformed_is_told_counted_and_survived():
    async def scenario(listener):
        with await listener.client() as client:
            client.sendall(b'{"name": "a", "id": "x", "data": NaN}\nhello\n{"name": "b"}\n')
            await until(lambda: listener.messages)
            assert [fault.id for _, fault in listener.faults] == ["x", None]
            assert listener.links[0].malformed == 2

    with_listener(scenario)


def test_a_line_without_end_is_dropped_and_the_link_stays():
    async def scenario(listener):
        with await listener.client() as client:
            client.setblocking(False)
            left = 5_000_000
            while left:
                try:
                    left -= client.send(b"x" * min(left, 65536))
                except BlockingIOError:
                    await sleep(0.001)
            client.setblocking(True)
            client.sendall(b'\n{"name": "next"}\n')
            await until(lambda: listener.messages)
            assert listener.links[0].dropped_too_long == 1
            assert not listener.lost

    with_listener(scenario)


def test_half_a_line_does_not_survive_its_connection():
    async def scenario(listener):
        with await listener.client() as client:
            client.sendall(b'{"name": "up.ar')
            await until(lambda: len(listener.links[0]._lines._buffer))
        await until(lambda: listener.lost)
        with await listener.client() as client:
            client.sendall(b'm"}\n{"name": "up.ok"}\n')
            await until(lambda: listener.messages)
            assert [message.name for _, message in listener.messages] == ["up.ok"]
            assert len(listener.faults) == 1
            assert listener.messages[0][0] is listener.links[1]

    with_listener(scenario)


def test_a_slow_reader_gets_the_newest_and_no_backlog():
    frames = 20_000

    async def scenario(listener):
        with await listener.client(receive_buffer=4096) as client:
            link = listener.links[0]
            padding = "x" * 400
            for number in range(frames):
                link.send_newest(encode("t", {"padding": padding}, beacon=number))
                if number % 50 == 0:
                    await sleep(0)
            newest = f'"beacon": {frames - 1}}}\n'.encode()
            received = await receive_all(client, lambda data: data.endswith(newest))
            beacons = [json.loads(line)["beacon"] for line in received.splitlines()]
            assert beacons == sorted(beacons)
            assert beacons[-1] == frames - 1
            # The kernel holds a little; the 8 MB between were never queued.
            assert len(beacons) < 200
            assert link.output.replaced > frames - 200

    with_listener(scenario)


def test_messages_to_a_stalled_reader_stay_in_order_and_within_a_bound():
    async def scenario(listener):
        with await listener.client(receive_buffer=4096) as client:
            link = listener.links[0]
            taken = []
            for number in range(2000):
                if link.send(encode("c", {"x": "y" * 980}, beacon=number)):
                    taken.append(number)
                await sleep(0)
            assert link.output.dropped == 2000 - len(taken) > 1000
            assert link.output._size <= 65536
            received = await receive_all(client, lambda data: data.count(b"\n") == len(taken))
            assert [json.loads(line)["beacon"] for line in received.splitlines()] == taken
            assert link.send(b"{}\n")

    with_listener(scenario)


def test_the_socket_notices_a_dead_peer():
    async def scenario(listener):
        with await listener.client():
            link = listener.links[0]
            handle = link.transport.getHandle()
            tcp = socket.IPPROTO_TCP
            assert handle.getsockopt(tcp, socket.TCP_USER_TIMEOUT) == 1500
            assert handle.getsockopt(tcp, socket.TCP_NODELAY)
            assert handle.getsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE)
            assert handle.getsockopt(tcp, socket.TCP_KEEPIDLE) == 3

    with_listener(scenario)


def test_closing_towards_a_stalled_reader_does_not_wait_for_it():
    async def scenario(listener):
        with await listener.client(receive_buffer=4096):
            link = listener.links[0]
            while link.send(b"x" * 1000):
                await sleep(0)
            link.close()
            await until(lambda: listener.lost)
            assert not link.send(b"late\n")
            assert not link.send_newest(b"late\n")

    # The system's own timeout, which is minutes, must not be what ends it.
    with_listener(scenario, user_timeout_ms=0)


def test_nothing_is_heard_after_closing():
    async def scenario(listener):
        with await listener.client() as client:
            listener.links[0]._on_message = lambda link, message: (
                listener.messages.append((link, message)),
                link.close(),
            )
            client.sendall(b'{"name": "a"}\n{"name": "b"}\n')
            await until(lambda: listener.lost)
            assert [message.name for _, message in listener.messages] == ["a"]

    with_listener(scenario)


def test_a_flood_costs_a_bounded_number_of_messages():
    clock, messages = Clock(), []
    link = GeneralMessageProtocol(
        clock,
        on_message=lambda link, message: messages.append(message),
        on_malformed=None,
        on_connected=lambda link: None,
        on_lost=None,
    )
    link.makeConnection(Transport("192.0.2.1"))
    for _ in range(30):
        clock.advance(0.1)
        link.dataReceived(b'{"name": "a"}\n' * 1000)
    assert MAX_BURST <= len(messages) <= MAX_BURST + 3 * MAX_MESSAGES_HZ
    assert len(messages) + link.bucket.refused == 30_000
    clock.advance(1)
    link.dataReceived(b'{"name": "after"}\n')
    assert messages[-1].name == "after"
