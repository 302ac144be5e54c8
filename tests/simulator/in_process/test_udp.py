import pytest
from twisted.internet.error import CannotListenError

from tests.simulator.in_process.peers import PORT, Datagrams
from up.system.udp import listen_udp
from up_simulator.in_process.reactor import SimulatedReactor
from up_simulator.link.model import LinkModel, LinkSettings


class Bench:
    def __init__(self, link=None):
        self.reactor = SimulatedReactor()
        self.pi, self.phone = self.reactor.host(), self.reactor.host()
        if link is not None:
            self.up, self.down = LinkModel(link, 1), LinkModel(link, 2)
            self.reactor.link(PORT, self.up, self.down)
        self.here, self.there = (Datagrams(self.reactor.seconds) for _ in range(2))
        self.listening = listen_udp(self.pi, PORT, self.there, "127.0.0.1")
        self.sending = self.phone.listenUDP(0, self.here)


def test_a_datagram_and_its_answer_arrive():
    bench = Bench()
    bench.sending.write(b"where?", ("127.0.0.1", PORT))
    bench.reactor.advance(0.01)
    (datagram, source, _) = bench.there.received[0]
    assert datagram == b"where?"
    bench.listening.write(b"here", source)
    bench.reactor.advance(0.01)
    assert bench.here.received[0][:2] == (b"here", ("127.0.0.1", PORT))


def test_the_link_of_the_port_applies_both_ways():
    bench = Bench(LinkSettings(delay_ms=100))
    bench.sending.write(b"x", ("127.0.0.1", PORT))
    bench.reactor.advance(0.5)
    arrived_s = bench.there.received[0][2]
    assert 0.1 <= arrived_s <= 0.105
    bench.listening.write(b"y", bench.there.received[0][1])
    bench.reactor.advance(0.5)
    assert bench.here.received[0][2] == pytest.approx(0.6, abs=0.01)
    bench.up.black_out()
    bench.sending.write(b"lost", ("127.0.0.1", PORT))
    bench.reactor.advance(1.0)
    bench.up.restore()
    bench.reactor.advance(1.0)
    assert len(bench.there.received) == 1


def test_a_datagram_without_a_receiver_is_lost():
    bench = Bench()
    bench.listening.stopListening()
    bench.sending.write(b"x", ("127.0.0.1", PORT))
    bench.reactor.advance(0.1)
    assert bench.there.received == []


def test_a_port_in_use_is_rejected():
    bench = Bench()
    with pytest.raises(CannotListenError, match=str(PORT)):
        listen_udp(bench.phone, PORT, Datagrams(bench.reactor.seconds))
