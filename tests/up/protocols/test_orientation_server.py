import socket
import struct

from twisted.internet.task import Clock

from tests.support.reactor import reactor, run_in_reactor, until
from tests.support.transport import Transport
from up.protocols.orientation_server import (
    MAX_BURST,
    MAX_FRAMES_HZ,
    OrientationDatagrams,
    OrientationFactory,
)

BAD = struct.pack(">6f", 400, 0, 0, 0, 0, 0)


def frame(number):
    return struct.pack(">6f", number, 2, 3, 4, 5, 6)


class Notes:
    def __init__(self):
        self.rolls = []
        self.events = []
        self.callbacks = {
            "on_orientation": lambda frame, source: self.rolls.append((frame.roll_deg, source)),
            "on_connected": lambda source: self.events.append(("connected", source)),
            "on_lost": lambda source, why: self.events.append(("lost", source, why)),
        }


def name(client):
    return f"127.0.0.1:{client.getsockname()[1]}"


def with_factory(scenario):
    async def run():
        notes = Notes()
        factory = OrientationFactory(reactor, **notes.callbacks)
        port = reactor.listenTCP(0, factory, interface="127.0.0.1")
        try:
            await scenario(notes, factory, ("127.0.0.1", port.getHost().port))
        finally:
            factory.close()
            await port.stopListening()

    run_in_reactor(run)


def test_frames_cut_anywhere_arrive():
    async def scenario(notes, factory, address):
        with socket.create_connection(address) as client:
            data = frame(1) + frame(2) + BAD + frame(3)
            for start in range(0, len(data), 7):
                client.sendall(data[start : start + 7])
            await until(lambda: len(notes.rolls) == 3)
            assert notes.rolls == [(1, name(client)), (2, name(client)), (3, name(client))]
            assert factory.counters.frames == 3
            assert factory.counters.dropped == 1

    with_factory(scenario)


def test_an_unfinished_frame_dies_with_its_connection():
    async def scenario(notes, factory, address):
        with socket.create_connection(address) as client:
            client.sendall(frame(1) + frame(9)[:10])
            await until(lambda: notes.rolls)
        await until(lambda: len(notes.events) == 2)
        assert notes.events[1][2] == "closed"
        with socket.create_connection(address) as client:
            client.sendall(frame(2))
            await until(lambda: len(notes.rolls) == 2)
        assert [roll for roll, _ in notes.rolls] == [1, 2]

    with_factory(scenario)


def connect(factory, number):
    """Return a connection of host 192.0.2.<number> without a socket."""
    connection = factory.buildProtocol(None)
    connection.makeConnection(Transport(f"192.0.2.{number}"))
    return connection


def test_a_connection_keeps_its_place_until_it_is_silent_for_1_s():
    clock, notes = Clock(), Notes()
    factory = OrientationFactory(clock, **notes.callbacks)
    first = connect(factory, 1)
    for number in range(3):
        clock.advance(0.9)
        first.dataReceived(frame(number))
        other = connect(factory, 2)
        other.dataReceived(frame(90))
        assert other.transport.disconnected
    assert [roll for roll, _ in notes.rolls] == [0, 1, 2]
    assert factory.counters.foreign == 3
    clock.advance(1.1)
    other = connect(factory, 2)
    other.dataReceived(frame(4))
    first.dataReceived(frame(5))
    assert [roll for roll, _ in notes.rolls] == [0, 1, 2, 4]
    assert first.transport.disconnected
    assert notes.events == [
        ("connected", "192.0.2.1:5000"),
        ("lost", "192.0.2.1:5000", "silent for 1 s"),
        ("connected", "192.0.2.2:5000"),
    ]
    assert factory.counters.replaced == 1


def test_another_connection_follows_one_that_closes():
    notes = Notes()
    factory = OrientationFactory(Clock(), **notes.callbacks)
    first = connect(factory, 1)
    first.dataReceived(frame(1))
    first.connectionLost()
    connect(factory, 2).dataReceived(frame(2))
    assert [roll for roll, _ in notes.rolls] == [1, 2]


def test_a_flood_costs_a_bounded_number_of_frames_and_keeps_the_newest():
    clock, notes = Clock(), Notes()
    factory = OrientationFactory(clock, **notes.callbacks)
    connection = connect(factory, 1)
    for _ in range(24):
        clock.advance(0.125)
        connection.dataReceived(b"".join(frame(number % 360) for number in range(2000)))
        assert notes.rolls[-1][0] == 1999 % 360
    assert len(notes.rolls) <= MAX_BURST + 3 * MAX_FRAMES_HZ
    assert factory.counters.frames + factory.counters.too_many == 48_000


def test_a_flood_of_datagrams_costs_a_bounded_number_of_frames():
    clock, notes = Clock(), Notes()
    server = OrientationDatagrams(clock, **notes.callbacks)
    for _ in range(30):
        clock.advance(0.1)
        for _ in range(1000):
            server.datagramReceived(frame(1), FIRST)
    assert MAX_BURST <= len(notes.rolls) <= MAX_BURST + 3 * MAX_FRAMES_HZ
    assert server.counters.frames + server.counters.too_many == 30_000


async def test_datagrams_arrive():
    notes = Notes()
    server = OrientationDatagrams(Clock(), **notes.callbacks)
    port = reactor.listenUDP(0, server, interface="127.0.0.1")
    address = ("127.0.0.1", port.getHost().port)
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
            client.bind(("127.0.0.1", 0))
            for datagram in (frame(1)[:23], frame(1) + b"x", b"", BAD, frame(7)):
                client.sendto(datagram, address)
            await until(lambda: notes.rolls)
            assert notes.rolls == [(7, name(client))]
            assert server.counters.dropped == 4
    finally:
        await port.stopListening()
    assert notes.events[-1][:2] == ("lost", notes.rolls[0][1])


FIRST, OTHER = ("192.0.2.1", 5000), ("192.0.2.2", 5000)


def test_another_address_is_taken_over_after_1_s_of_silence():
    clock, notes = Clock(), Notes()
    server = OrientationDatagrams(clock, **notes.callbacks)
    server.datagramReceived(frame(1), FIRST)
    clock.advance(0.9)
    server.datagramReceived(frame(2), OTHER)
    server.datagramReceived(frame(3), FIRST)
    clock.advance(0.9)
    server.datagramReceived(frame(4), OTHER)
    assert [roll for roll, _ in notes.rolls] == [1, 3]
    assert server.counters.foreign == 2
    clock.advance(0.1)
    server.datagramReceived(frame(5), OTHER)
    server.datagramReceived(frame(6), FIRST)
    assert [roll for roll, _ in notes.rolls] == [1, 3, 5]
    assert notes.events == [
        ("connected", "192.0.2.1:5000"),
        ("lost", "192.0.2.1:5000", "silent for 1 s"),
        ("connected", "192.0.2.2:5000"),
    ]


def test_garbage_neither_makes_nor_keeps_a_source():
    clock, notes = Clock(), Notes()
    server = OrientationDatagrams(clock, **notes.callbacks)
    server.datagramReceived(BAD, OTHER)
    assert notes.events == []
    server.datagramReceived(frame(1), FIRST)
    clock.advance(0.6)
    server.datagramReceived(BAD, FIRST)
    clock.advance(0.6)
    server.datagramReceived(frame(2), OTHER)
    assert [roll for roll, _ in notes.rolls] == [1, 2]
    server.stopProtocol()
    assert not clock.getDelayedCalls()
