import errno
import socket

from twisted.internet.task import Clock

from tests.support.reactor import reactor, run_in_reactor, until
from up.protocols.general_message import encode
from up.protocols.general_message_link import MAX_BURST, MAX_MESSAGES_HZ
from up.protocols.general_message_udp import GeneralMessageDatagrams


class Notes:
    def __init__(self, clock):
        self.messages, self.faults, self.connected, self.lost = [], [], [], []
        self.link = GeneralMessageDatagrams(
            clock,
            on_message=lambda link, message: self.messages.append(message),
            on_malformed=lambda link, fault: self.faults.append(fault),
            on_connected=self.connected.append,
            on_lost=lambda link, why: self.lost.append(why),
        )


def client():
    result = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    result.bind(("127.0.0.1", 0))
    result.settimeout(10)
    return result


def with_port(scenario):
    async def run():
        notes = Notes(Clock())
        port = reactor.listenUDP(0, notes.link, interface="127.0.0.1")
        address = ("127.0.0.1", port.getHost().port)
        try:
            with client() as first, client() as second:
                await scenario(notes, address, first, second)
        finally:
            await port.stopListening()

    run_in_reactor(run)


def test_the_first_address_keeps_its_place():
    async def scenario(notes, address, first, second):
        assert not notes.link.send(b"{}\n")
        first.sendto(b'{"name": "a"}\n', address)
        await until(lambda: len(notes.messages) == 1)
        assert notes.link.send(encode("up.ack", {}))
        assert b"up.ack" in first.recv(2000)
        second.sendto(b'{"name": "b"}', address)
        await until(lambda: notes.link.foreign == 1)
        assert notes.link.peer == f"127.0.0.1:{first.getsockname()[1]}"
        assert notes.link.send_newest(encode("up.telemetry.update", {}))
        assert b"telemetry" in first.recv(2000)
        assert [message.name for message in notes.messages] == ["a"]
        assert notes.connected == [notes.link]
        assert notes.link.dropped == 1

    with_port(scenario)


def test_one_object_a_datagram_and_nothing_joins_two():
    async def scenario(notes, address, first, second):
        first.sendto(b'{"name": "a"}\n{"name": "b"}\n', address)
        first.sendto(b'{"name": ', address)
        first.sendto(b'"c"}', address)
        first.sendto(b"\n", address)
        first.sendto(b"", address)
        first.sendto(b'{"name": "big", "data": {"x": "' + b"y" * 20000 + b'"}}', address)
        first.sendto(encode("long", {"x": "y" * 16000}), address)
        await until(lambda: notes.messages)
        assert [message.name for message in notes.messages] == ["long"]
        assert len(notes.faults) == notes.link.malformed == 4

    with_port(scenario)


def test_a_silent_peer_is_lost_and_comes_back():
    clock = Clock()
    notes = Notes(clock)
    notes.link.datagramReceived(b"", ("192.0.2.1", 5))
    clock.advance(1.4)
    notes.link.datagramReceived(b"", ("192.0.2.1", 5))
    clock.advance(1.0)
    notes.link.datagramReceived(b"", ("192.0.2.2", 5))
    clock.advance(0.4)
    assert notes.lost == []
    clock.advance(0.1)
    assert len(notes.lost) == 1
    assert notes.link.peer == ""
    assert not notes.link.send(b"{}\n")
    notes.link.datagramReceived(b"", ("192.0.2.2", 5))
    assert len(notes.connected) == 2
    notes.link.close()
    assert not clock.getDelayedCalls()


def test_a_network_that_is_down_is_counted():
    class Down:
        def write(self, message, address):
            raise OSError(errno.ENETUNREACH, "unreachable")

    notes = Notes(Clock())
    notes.link.transport = Down()
    notes.link.datagramReceived(b"", ("192.0.2.1", 5))
    assert not notes.link.send(b"{}\n")
    assert notes.link.dropped == 1


def test_a_flood_costs_a_bounded_number_of_messages():
    clock = Clock()
    notes = Notes(clock)
    for _ in range(30):
        clock.advance(0.1)
        for _ in range(1000):
            notes.link.datagramReceived(b'{"name": "a"}', ("192.0.2.1", 5))
    assert MAX_BURST <= len(notes.messages) <= MAX_BURST + 3 * MAX_MESSAGES_HZ
    assert len(notes.messages) + notes.link.bucket.refused == 30_000
