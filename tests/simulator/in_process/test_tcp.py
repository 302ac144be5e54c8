"""TCP in memory behaves as that of a system, with and without a link in between."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from twisted.internet.error import CannotListenError
from twisted.internet.interfaces import IPushProducer
from twisted.logger import capturedLogs
from zope.interface import implementer

from tests.simulator.in_process.peers import PORT, Bench
from up.protocols.tcp_options import watch_peer
from up_simulator.link.model import LinkSettings

SLOW = LinkSettings(delay_ms=50)
LINKS = st.builds(
    LinkSettings,
    delay_ms=st.floats(0, 300),
    jitter_ms=st.floats(0, 50),
    loss_percent=st.floats(0, 20),
    rate_bytes_s=st.one_of(st.just(0.0), st.floats(2e4, 1e6)),
)


def test_bytes_pass_both_ways_after_the_delay():
    bench = Bench(SLOW)
    bench.connect()
    sent_s = bench.reactor.seconds()
    bench.here.transport.write(b"up")
    bench.there.transport.writeSequence([b"do", b"wn"])
    bench.reactor.advance(1.0)
    assert (bench.there.received, bench.here.received) == (b"up", b"down")
    (arrived_s,) = bench.there.arrivals_s
    assert 0.05 <= arrived_s - sent_s <= 0.056


@settings(max_examples=30, deadline=None)
@given(LINKS, st.integers(0, 99), st.lists(st.binary(min_size=1, max_size=20_000), max_size=8))
def test_a_stream_arrives_whole_and_in_order_over_any_link(link, seed, pieces):
    bench = Bench(link, seed=seed)
    bench.connect(wait_s=20.0)
    for piece in pieces:
        bench.here.transport.write(piece)
        bench.there.transport.write(piece[::-1])
        bench.reactor.advance(0.05)
    bench.here.transport.loseConnection()
    bench.reactor.advance(300.0)
    assert bench.there.received == b"".join(pieces)
    assert (bench.here.lost, bench.there.lost) == ("ConnectionDone", "ConnectionDone")
    assert not bench.pi.opened.keys() - {bench.port}
    assert not bench.phone.opened


def test_a_closed_port_refuses():
    bench = Bench(SLOW)
    bench.connect(port=PORT + 1)
    assert bench.client.failed == "ConnectionRefusedError"


def test_in_a_blackout_the_attempt_times_out():
    bench = Bench(SLOW)
    bench.black_out()
    bench.connect(timeout=5, wait_s=4.9)
    assert bench.client.failed is None
    bench.reactor.advance(0.2)
    assert bench.client.failed == "TimeoutError"


def test_a_lost_handshake_is_repeated():
    bench = Bench(SLOW)
    bench.black_out()
    bench.connect(wait_s=0.5)
    bench.restore()
    bench.reactor.advance(1.0)
    assert bench.here.transport.connected


def test_an_attempt_may_be_cancelled():
    bench = Bench(SLOW)
    connector = bench.connect(wait_s=0.01)
    connector.stopConnecting()
    bench.reactor.advance(1.0)
    assert bench.client.failed == "UserError"
    assert bench.client.built == []


def test_a_port_in_use_is_rejected_and_0_selects_a_free_one():
    bench = Bench()
    with pytest.raises(CannotListenError, match=str(PORT)):
        bench.phone.listenTCP(PORT, bench.server)
    first, second = (bench.pi.listenTCP(0, bench.server).getHost().port for _ in range(2))
    assert len({first, second, PORT}) == 3
    bench.port.stopListening()
    assert bench.phone.listenTCP(PORT, bench.server).getHost().port == PORT


def test_a_factory_without_a_protocol_refuses_the_connection():
    bench = Bench(there=lambda: None)
    bench.connect()
    assert bench.here.lost == "ConnectionLost"
    assert bench.client.lost == "ConnectionLost"


def test_queued_data_is_sent_before_the_connection_closes():
    bench = Bench(LinkSettings(delay_ms=20, rate_bytes_s=50_000))
    bench.connect()
    bench.here.transport.write(b"x" * 100_000)
    bench.here.transport.loseConnection()
    bench.reactor.advance(0.5)
    assert bench.here.lost is None
    bench.reactor.advance(5.0)
    assert len(bench.there.received) == 100_000
    assert (bench.here.lost, bench.there.lost) == ("ConnectionDone", "ConnectionDone")


def test_an_aborted_connection_is_reset_at_the_other_side():
    bench = Bench(SLOW)
    bench.connect()
    bench.here.transport.abortConnection()
    bench.reactor.advance(0.02)
    assert (bench.here.lost, bench.there.lost) == ("ConnectionAborted", None)
    bench.reactor.advance(0.1)
    assert bench.there.lost == "ConnectionLost"


@implementer(IPushProducer)
class Push:
    def __init__(self):
        self.said = ""

    def pauseProducing(self):  # noqa: N802
        self.said += "p"

    def resumeProducing(self):  # noqa: N802
        self.said += "r"

    def stopProducing(self):  # noqa: N802
        self.said += "s"


def test_a_push_producer_is_paused_while_the_queue_is_long():
    bench = Bench(SLOW)
    bench.connect()
    producer = Push()
    bench.here.transport.registerProducer(producer, True)
    bench.here.transport.write(b"x" * 65_536)
    assert producer.said == ""
    bench.here.transport.write(b"x")
    assert producer.said == "p"
    bench.reactor.advance(5.0)
    assert producer.said == "pr"
    assert len(bench.there.received) == 65_537


def test_unacknowledged_bytes_end_the_connection_after_the_user_timeout():
    bench = Bench(SLOW)
    bench.connect()
    watch_peer(bench.there.transport, 1500)
    bench.reactor.advance(1.0)
    bench.black_out()
    began_s = bench.reactor.seconds()
    bench.there.transport.write(b"telemetry")
    bench.reactor.advance(3.0)
    assert bench.there.lost == "ConnectionLost"
    assert bench.there.lost_s - began_s == pytest.approx(1.5, abs=0.01)
    # The other side has no notice of it: it finds out when it sends.
    bench.restore()
    bench.reactor.advance(20.0)
    assert bench.here.lost is None
    bench.here.transport.write(b"late")
    bench.reactor.advance(0.5)
    assert bench.here.lost == "ConnectionLost"
    assert bench.here.received == b""


def test_a_short_blackout_only_delays_data():
    bench = Bench(SLOW)
    bench.connect()
    watch_peer(bench.there.transport, 1500)
    bench.there.transport.write(b"1")
    bench.reactor.advance(1.0)
    bench.black_out()
    bench.there.transport.write(b"2")
    bench.reactor.advance(0.5)
    bench.restore()
    bench.reactor.advance(1.5)
    assert bench.here.received == b"12"
    assert bench.there.lost is None


def test_a_kill_closes_the_connections_of_the_program():
    bench = Bench(SLOW)
    bench.connect()
    bench.here.transport.write(b"sent")
    bench.reactor.advance(0.002)
    bench.here.transport.write(b"not sent")
    bench.phone.cut_off()
    bench.reactor.advance(1.0)
    assert bench.there.received == b"sent"
    assert bench.there.lost == "ConnectionDone"
    assert bench.here.lost is None, "a killed program is not called"


def test_a_protocol_that_raises_loses_only_its_own_connection():
    bench = Bench(SLOW)
    first, second = Bench.recorder(bench), Bench.recorder(bench)
    built = iter((first, second))
    bench.server.build = lambda: next(built)
    bench.connect()
    bench.connect()
    first.dataReceived = lambda data: 1 / 0
    with capturedLogs() as events:
        for client in bench.client.built:
            client.transport.write(b"x")
        bench.reactor.advance(1.0)
    assert first.lost == "ZeroDivisionError"
    assert second.received == b"x"
    assert second.lost is None
    assert bench.client.built[0].lost == "ConnectionLost"
    assert len(events) == 1


def test_addresses_are_available():
    bench = Bench(SLOW)
    bench.connect()
    here, there = bench.here.transport, bench.there.transport
    assert here.getPeer().port == PORT == there.getHost().port
    assert here.getHost() == there.getPeer() == bench.server.peers[0]
