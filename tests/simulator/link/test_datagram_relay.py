"""Datagrams over a link between real sockets: late, lost, in a burst, never changed."""

from hypothesis import given, settings
from hypothesis import strategies as st
from twisted.internet.task import Clock

from tests.simulator.link.peers import UdpPeer, flown, turn
from tests.support.reactor import reactor
from up_simulator.link.datagram_relay import MAX_CLIENTS, MAX_QUEUED, DatagramRelay
from up_simulator.link.model import LinkModel, LinkSettings


class Bench:
    """A target that keeps, or answers, its datagrams; a relay in front of it; clients."""

    def __init__(self, up=None, down=None):
        self.clock = Clock()
        self.up = LinkModel(up or LinkSettings(), 1)
        self.down = LinkModel(down or LinkSettings(), 2)
        self.target = UdpPeer()
        self.ports = []

    async def __aenter__(self):
        target = self.open(self.target)
        self.relay = DatagramRelay(
            reactor, 0, "127.0.0.1", target, self.up, self.down, clock=self.clock
        )
        self.relay.start()
        return self

    async def __aexit__(self, *exception):
        await self.relay.stop()
        for port in self.ports:
            await port.stopListening()
        assert self.clock.getDelayedCalls() == []

    def open(self, peer):
        port = reactor.listenUDP(0, peer, interface="127.0.0.1")
        self.ports.append(port)
        return port.getHost().port

    def client(self):
        peer = UdpPeer()
        self.open(peer)
        return peer

    async def send(self, client, data):
        client.transport.write(data, ("127.0.0.1", self.relay.port))
        await turn(4)

    async def pass_s(self, seconds):
        end_s = self.clock.seconds() + seconds
        await turn(4)
        while due := [
            each.getTime() for each in self.clock.getDelayedCalls() if each.getTime() <= end_s
        ]:
            self.clock.advance(max(0.0, min(due) - self.clock.seconds()))
            await turn(4)
        self.clock.advance(max(0.0, end_s - self.clock.seconds()))
        await turn(4)

    @property
    def arrived(self):
        return [data for data, _ in self.target.got]


def test_a_datagram_has_the_delay_of_the_link_and_its_answer_reaches_its_client():
    async def fly():
        async with Bench(LinkSettings(delay_ms=100), LinkSettings(delay_ms=50)) as bench:
            first, second = bench.client(), bench.client()
            await bench.send(first, b"one")
            await bench.send(second, b"two")
            await bench.pass_s(0.0999)
            assert bench.arrived == []
            await bench.pass_s(0.0002)
            assert bench.arrived == [b"one", b"two"]
            for data, address in reversed(bench.target.got):
                bench.target.transport.write(b"re " + data, address)
            await turn()
            await bench.pass_s(0.0498)
            assert first.got == second.got == []
            await bench.pass_s(0.0003)
            near = ("127.0.0.1", bench.relay.port)
            assert first.got == [(b"re one", near)]
            assert second.got == [(b"re two", near)]

    flown(fly)


@settings(max_examples=20, deadline=None)
@given(
    st.builds(
        LinkSettings,
        delay_ms=st.sampled_from([0.0, 60.0]),
        jitter_ms=st.sampled_from([0.0, 200.0]),
        loss_percent=st.sampled_from([0.0, 30.0, 100.0]),
        rate_bytes_s=st.sampled_from([0.0, 5000.0]),
    ),
    st.lists(st.binary(max_size=60), max_size=30),
)
def test_datagrams_arrive_unchanged_and_in_order(link, datagrams):
    async def fly():
        async with Bench(link) as bench:
            client = bench.client()
            sent = [bytes((at,)) + data for at, data in enumerate(datagrams)]
            for data in sent:
                await bench.send(client, data)
            await bench.pass_s(60)
            arrived = bench.arrived
            assert arrived == sorted(arrived, key=lambda data: data[0])
            assert set(arrived) <= set(sent)
            assert len(arrived) + bench.relay.lost == len(sent)
            if link.loss_percent in (0, 100):
                assert len(arrived) == (0 if link.loss_percent else len(sent))

    flown(fly)


def test_the_queue_is_bounded():
    async def fly():
        async with Bench() as bench:
            client = bench.client()
            bench.up.stall(bench.clock.seconds())
            for at in range(MAX_QUEUED + 40):
                await bench.send(client, at.to_bytes(2))
            bench.up.resume(bench.clock.seconds())
            await bench.pass_s(1)
            assert len(bench.arrived) == MAX_QUEUED
            assert bench.relay.lost == 40

    flown(fly)


def test_beyond_the_maximum_the_oldest_client_is_dropped():
    async def fly():
        async with Bench() as bench:
            clients = [bench.client() for _ in range(MAX_CLIENTS + 3)]
            for at, client in enumerate(clients):
                await bench.send(client, b"%d" % at)
                await bench.pass_s(0)
            assert len(bench.arrived) == len(clients)
            assert len(bench.relay._clients) == MAX_CLIENTS
            data, address = bench.target.got[-1]
            bench.target.transport.write(data, address)
            await turn()
            await bench.pass_s(0)
            assert [data for data, _ in clients[-1].got] == [data]
            # A forgotten sender is known again with its next datagram.
            await bench.send(clients[0], b"again")
            await bench.pass_s(0)
            assert bench.arrived[-1] == b"again"

    flown(fly)
