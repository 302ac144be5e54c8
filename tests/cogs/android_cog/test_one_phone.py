"""One phone at a time: the owner of the link, and the fate of the others."""

from android_cog.phone_link import MAX_UNDECIDED, MAX_UNDECIDED_LINE, PhoneLink
from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.protocol import Factory
from twisted.internet.task import Clock

from tests.cogs.android_cog.flight import Flight
from tests.cogs.peers import Peer, UdpPeer
from tests.support.reactor import reactor, until
from tests.support.transport import Transport
from tests.up.commands.samples import Log
from up.commands.location_command import LocationCommand
from up.commands.orientation_command import OrientationCommand
from up.protocols import general_message_link
from up.protocols.general_message import decode
from up.protocols.general_message_link import MAX_BURST
from up.protocols.general_message_udp import SILENCE_TIMEOUT_S
from up.system.peer_filter import PeerFilter


def place(latitude, id=None):
    data = {"latitude": latitude, "longitude": 14}
    return {"name": "up.location.update", "data": data, "id": id}


async def phone_at(flight, host, port="general"):
    """Connect from another loopback address, which stands for another machine."""
    factory = Factory.forProtocol(Peer)
    endpoint = TCP4ClientEndpoint(
        reactor, "127.0.0.1", flight.up.ports[port], bindAddress=(host, 0)
    )
    peer = await endpoint.connect(factory)
    flight.peers.append(peer)
    return peer


def latitudes(flight):
    return [command.latitude_deg for command in flight.heard]


async def test_a_second_phone_is_refused_named_and_shown(tmp_path):
    async with Flight(tmp_path) as f:
        f.listen_to(LocationCommand)
        owner = await f.phone()
        owner.say(place(1, "aa01.1"))
        await owner.answer("aa01.1")
        # Of the same host, as a second simulator; of another host with an id; without one.
        for host, id_ in (("127.0.0.1", "bb02.1"), ("127.0.0.2", "cc03.1"), ("127.0.0.3", 7)):
            other = await phone_at(f, host)
            with Log() as log:
                other.say(place(50, id_), place(51))
                answer = (await other.answer(str(id_)))["data"]
                await other.closed
            assert answer["code"] == "taken"
            assert f"127.0.0.1:{owner.transport.getHost().port}" in answer["reason"]
            assert f.telemetry["android"]["competitor"] == host
            codes = [each["code"] for each in log.events if "code" in each]
            assert codes in (["phone_rejected"], [])
        owner.say(place(2, "aa01.2"))
        await owner.answer("aa01.2")
        assert latitudes(f) == [1, 2]
        assert f.telemetry["counters"]["android"]["rejected"] == 3


async def test_the_same_phone_from_another_network_replaces_its_connection(tmp_path):
    async with Flight(tmp_path) as f:
        f.listen_to(LocationCommand)
        old = await f.phone()
        old.say(place(1, "aa01.1"))
        await old.answer("aa01.1")
        new = await phone_at(f, "127.0.0.2")
        new.say(place(2, "aa01.2"))
        await new.answer("aa01.2")
        await old.closed
        assert latitudes(f) == [1, 2]
        assert f.telemetry["counters"]["android"]["rejected"] == 0


async def test_a_legacy_phone_is_known_by_its_host(tmp_path):
    async with Flight(tmp_path) as f:
        f.listen_to(LocationCommand)
        old = await f.phone()
        old.say(place(1, "id"))
        await old.answer("id")
        other = await phone_at(f, "127.0.0.2")
        other.say(place(50, "id"))
        await other.closed
        new = await f.phone()
        new.say(place(2, "new"))
        await new.answer("new")
        await old.closed
        assert latitudes(f) == [1, 2]


async def test_a_strangers_lines_cost_one_short_decoding(tmp_path, monkeypatch):
    """A line that breaks a rule at its end costs 20 ms; ten of them stopped the control loop."""
    decoded = []
    strict = general_message_link.decode

    def counting(line, longest):
        decoded.append(min(len(line), longest))
        return strict(line, longest)

    async with Flight(tmp_path) as f:
        owner = await f.phone()
        owner.say(place(1, "aa01.1"))
        await owner.answer("aa01.1")
        monkeypatch.setattr(general_message_link, "decode", counting)
        hostile = b'{"name":"u","data":{"x":[' + b"{}," * 5000 + b'{"a":1,"a":2}]}}\n'
        other = await phone_at(f, "127.0.0.2")
        other.transport.write(hostile * 4)
        await other.closed
        assert decoded == [MAX_UNDECIDED_LINE]
        # The owner's own lines may be long.
        owner.transport.write(hostile)
        owner.say(place(2, "aa01.2"))
        await owner.answer("aa01.2")
        assert f.telemetry["counters"]["android"]["rejected"] == 1


async def test_datagrams_of_another_phone_are_dropped_and_counted(tmp_path):
    async with Flight(tmp_path) as f:
        f.listen_to(LocationCommand, OrientationCommand)
        owner = await f.phone()
        owner.say(place(1, "aa01.1"))
        await owner.answer("aa01.1")
        other = UdpPeer(reactor, "127.0.0.2")
        f.peers.append(other)
        other.say(place(50, "bb02.1"), f.up.ports["general"])
        other.say(b"\0" * 24, f.up.ports["orientation"])
        await until(lambda: other.datagrams)
        assert decode(other.datagrams[0]).data["code"] == "taken"
        counters = lambda: f.telemetry["counters"]["android"]  # noqa: E731
        await until(lambda: counters()["orientation_rejected"] == 1)
        assert counters()["foreign"] == 1
        gyro = await phone_at(f, "127.0.0.2", "orientation")
        await gyro.closed
        mine = await f.gyro()
        mine.say(b"\0" * 24)
        await until(lambda: len(f.heard) == 2)
        assert isinstance(f.heard[1], OrientationCommand)


async def test_orientation_that_came_before_the_phone_of_another_host_ends(tmp_path):
    async with Flight(tmp_path) as f:
        gyro = await phone_at(f, "127.0.0.2", "orientation")
        gyro.say(b"\0" * 24)
        await until(lambda: f.provider._orientation.connected)
        await f.phone()
        await gyro.closed
        await until(lambda: not f.provider._orientation.connected)


class Answers(list):
    """Takes datagrams."""

    def write(self, datagram, address):
        self.append((datagram, address))


class Rig:
    """A PhoneLink on a clock that stands still, and connections without sockets."""

    def __init__(self):
        self.clock = Clock()
        self.messages, self.events = [], []
        self.link = PhoneLink(
            self.clock,
            PeerFilter(True, "key"),
            on_message=lambda link, message: self.messages.append(message.data["n"]),
            on_malformed=lambda link, fault: self.events.append("malformed"),
            on_connected=lambda link: self.events.append(f"connected {link.peer}"),
            on_lost=lambda link, why: self.events.append("lost"),
            on_rejected=lambda peer: self.events.append(f"rejected {peer}"),
        )
        self.link.datagrams.transport = Answers()

    def connect(self, host, port=5):
        link = self.link.build()
        link.makeConnection(Transport(host, port))
        return link

    def datagram(self, n, address, id=None):
        self.link.datagrams.datagramReceived(line(n, id), address)


def line(n, id=None):
    return (b'{"name": "a", "data": {"n": %d}, "id": %s}\n') % (
        n,
        b"null" if id is None else b'"%s"' % id.encode(),
    )


FIRST, OTHER = "192.0.2.1", "192.0.2.2"


def test_a_silent_owner_loses_its_place():
    rig = Rig()
    owner = rig.connect(FIRST)
    owner.dataReceived(line(1, "aa01.1"))
    rig.clock.advance(SILENCE_TIMEOUT_S - 0.1)
    owner.dataReceived(b"\n")
    rig.clock.advance(SILENCE_TIMEOUT_S - 0.1)
    early = rig.connect(OTHER)
    early.dataReceived(line(50, "bb02.1"))
    assert early.transport.disconnecting
    rig.clock.advance(0.2)
    late = rig.connect(OTHER)
    late.dataReceived(line(2, "bb02.2"))
    owner.dataReceived(line(51, "aa01.2"))
    assert rig.messages == [1, 2]
    assert rig.link.current is late


def test_a_connection_that_says_nothing_is_decided_after_its_time():
    rig = Rig()
    owner, other = rig.connect(FIRST), rig.connect(OTHER)
    for _ in range(int(SILENCE_TIMEOUT_S / 0.5) + 1):
        owner.dataReceived(b"\n")
        other.dataReceived(b"\nrubbish\n")
        rig.clock.advance(0.5)
    assert rig.link.rejected == 1
    assert rig.link.current is owner
    assert rig.events == [f"connected {FIRST}:5", f"rejected {OTHER}:5"]


def test_connections_that_say_nothing_are_bounded():
    rig = Rig()
    owner = rig.connect(FIRST)
    for port in range(100):
        rig.connect(OTHER, port)
    assert rig.link.rejected == 100 - MAX_UNDECIDED
    assert rig.link.current is owner


def test_a_flood_of_another_phone_leaves_the_owner_its_tokens():
    rig = Rig()
    rig.datagram(1, (FIRST, 5))
    for number in range(5000):
        rig.datagram(50, (OTHER, 5), f"bb02.{number}")
        rig.connect(OTHER, number).dataReceived(line(50, f"bb02.{number}") * 10)
    for _ in range(100):
        rig.datagram(2, (FIRST, 5))
    assert rig.messages == [1, *[2] * 100]
    # Few of the foreign datagrams are read, and each connection's first message.
    assert rig.link.datagrams.foreign == 5000
    assert rig.link.rejected <= 5000 + 10


def test_the_owner_on_datagrams_is_known_by_its_identity_from_another_port():
    rig = Rig()
    rig.datagram(1, (FIRST, 5), "aa01.1")
    rig.datagram(50, (FIRST, 6))
    rig.datagram(51, (FIRST, 7), "bb02.1")
    rig.datagram(2, (OTHER, 8), "aa01.2")
    rig.datagram(52, (FIRST, 5))
    assert rig.messages == [1, 2]
    assert rig.link.current.peer == f"{OTHER}:8"
    stream = rig.connect(FIRST)
    stream.dataReceived(line(3, "aa01.3"))
    assert rig.messages == [1, 2, 3]
    assert rig.link.current is stream
    assert rig.link.datagrams.peer == ""


def test_a_phone_that_reconnects_keeps_its_empty_bucket():
    rig = Rig()
    for port in range(10):
        rig.connect(FIRST, port).dataReceived(line(1) * 1000)
    assert len(rig.messages) == MAX_BURST
    assert rig.link.bucket.refused == 10_000 - MAX_BURST
