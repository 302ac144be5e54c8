"""The relay between real sockets: every byte, in order, on the link's schedule; and its faults."""

from socket import SO_RCVBUF, SO_SNDBUF, SOL_SOCKET

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.simulator.link.peers import Bench, flown, turn
from tests.support.reactor import reactor, until
from up_simulator.link.model import LinkModel, LinkSettings
from up_simulator.link.relay import LinkRelay, LinkRelayError
from up_simulator.link.relay_connection import WINDOW

LINKS = st.builds(
    LinkSettings,
    delay_ms=st.sampled_from([0.0, 1.0, 80.0, 700.0]),
    jitter_ms=st.sampled_from([0.0, 30.0, 300.0]),
    loss_percent=st.sampled_from([0.0, 5.0, 60.0]),
    rate_bytes_s=st.sampled_from([0.0, 3000.0, 250000.0]),
)
FAULTS = st.lists(
    st.tuples(
        st.floats(0.0, 3.0),
        st.sampled_from(["stall", "resume", "black_out", "restore"]),
        st.booleans(),
    ),
    max_size=6,
)
MESSAGES = st.lists(
    st.tuples(st.booleans(), st.integers(1, 40_000), st.floats(0.0, 0.4)), min_size=1, max_size=8
)


def pattern(size, key):
    """Return bytes of which no part looks like another."""
    return b"".join((key * 1_000_003 + at).to_bytes(4) for at in range(size // 4 + 1))[:size]


@settings(max_examples=50, deadline=None)
@given(LINKS, LINKS, MESSAGES, FAULTS)
def test_every_byte_arrives_in_order_whatever_the_link_does(up, down, messages, faults):
    async def fly():
        async with Bench(up, down) as bench:
            client, target = await bench.pair()
            wanted = {id(client): bytearray(), id(target): bytearray()}
            actions = [(at_s, "fault", name, is_up) for at_s, name, is_up in faults]
            at_s = 0.0
            for key, (is_up, size, pause_s) in enumerate(messages):
                at_s += pause_s
                actions.append((at_s, "send", pattern(size, key), is_up))
            start_s = bench.clock.seconds()
            for at_s, what, detail, is_up in sorted(actions, key=lambda each: each[0]):
                await bench.pass_s(max(0.0, start_s + at_s - bench.clock.seconds()))
                model = bench.up if is_up else bench.down
                if what == "send":
                    (client if is_up else target).send(detail)
                    wanted[id(target if is_up else client)] += detail
                elif detail == "resume":
                    model.resume(bench.clock.seconds())
                else:
                    getattr(model, detail)()
                for end in (client, target):
                    assert wanted[id(end)].startswith(end.data)
            for model in (bench.up, bench.down):
                model.restore()
                model.resume(bench.clock.seconds())
            client.transport.loseWriteConnection()
            target.transport.loseWriteConnection()
            await bench.wait_for(lambda: client.is_finished and target.is_finished, 4000)
            assert client.data == wanted[id(client)]
            assert target.data == wanted[id(target)]
            await until(lambda: not bench.relay.connections)

    flown(fly)


def test_bytes_have_the_delay_of_the_link():
    async def fly():
        async with Bench(LinkSettings(delay_ms=100), LinkSettings(delay_ms=40)) as bench:
            client = await bench.client()
            await bench.pass_s(0.0995)
            assert bench.targets == []
            await bench.pass_s(0.001)
            [target] = bench.targets
            # The target may send immediately; its answer and the opening's come together.
            target.send(b"hello")
            await bench.pass_s(0.039)
            assert not client.data
            await bench.pass_s(0.002)
            assert client.data == b"hello"
            client.send(b"first")
            await bench.pass_s(0.05)
            client.send(b"second")
            await bench.pass_s(0.0499)
            assert not target.data
            await bench.pass_s(0.0002)
            assert target.data == b"first"
            await bench.pass_s(0.05)
            assert target.data == b"firstsecond"

    flown(fly)


def black_out(bench):
    bench.up.black_out()
    bench.down.black_out()


def restore(bench):
    bench.up.restore()
    bench.down.restore()


def test_in_a_blackout_nothing_passes_and_no_end_is_notified():
    async def fly():
        async with Bench(LinkSettings(delay_ms=50), LinkSettings(delay_ms=50)) as bench:
            client, target = await bench.pair()
            client.send(b"on its way")
            await bench.pass_s(0.02)
            black_out(bench)
            target.send(b"into the dark")
            await bench.pass_s(30)
            late = await bench.client()
            late.send(b"hanging")
            await bench.pass_s(10)
            assert not client.data and not target.data
            assert not (client.is_lost or target.is_lost or late.is_lost)
            assert not (client.is_finished or target.is_finished or late.is_finished)
            assert len(bench.targets) == 1
            assert len(bench.relay.connections) == 2
            restore(bench)
            # As TCP does: the pause between two retries has doubled until it was as long as that.
            await bench.pass_s(45)
            assert target.data == b"on its way"
            assert client.data == b"into the dark"
            assert bench.targets[1].data == b"hanging"

    flown(fly)


@pytest.mark.parametrize("who", ["client", "target"])
def test_the_peer_of_an_end_that_closed_in_a_blackout_is_closed_after_it(who):
    async def fly():
        async with Bench(LinkSettings(delay_ms=20), LinkSettings(delay_ms=20)) as bench:
            ends = dict(zip(("client", "target"), await bench.pair(), strict=True))
            gone, left = ends.pop(who), next(iter(ends.values()))
            black_out(bench)
            gone.send(b"never acknowledged")
            await bench.pass_s(5)
            gone.transport.abortConnection()
            await bench.pass_s(60)
            assert gone.is_lost
            assert not left.is_lost and not left.is_finished
            restore(bench)
            await bench.pass_s(1.1)
            await until(lambda: left.is_lost)
            assert left.was_aborted
            assert not left.data
            assert not bench.relay.connections

    flown(fly)


def test_the_user_timeout_closes_only_the_sender():
    async def fly():
        async with Bench(user_timeout_s=1.5) as bench:
            client, target = await bench.pair()
            idle, _ = await bench.pair()
            black_out(bench)
            client.send(b"beat")
            await bench.pass_s(1.4)
            assert not client.is_lost
            await bench.pass_s(0.2)
            await until(lambda: client.is_lost)
            await bench.pass_s(20)
            assert not target.is_lost
            assert not idle.is_lost, "an idle connection has nothing to wait for"
            restore(bench)
            await bench.pass_s(1.1)
            await until(lambda: target.is_lost)

    flown(fly)


def test_a_paused_reader_stops_the_sender_within_bounded_memory():
    async def fly():
        async with Bench(LinkSettings(delay_ms=5)) as bench:
            client, target = await bench.pair()
            # The buffers of the two systems are not the relay's.
            client.transport.getHandle().setsockopt(SOL_SOCKET, SO_SNDBUF, 32768)
            target.transport.getHandle().setsockopt(SOL_SOCKET, SO_RCVBUF, 32768)
            target.transport.pauseProducing()
            data = pattern(4_000_000, 1)
            client.send(data)
            left = None
            while left != (left := len(data) - unsent(client)):
                await bench.pass_s(1.0)
                assert bench.waiting <= WINDOW + 65536
            assert left < 600_000, "the relay continued to read"
            target.transport.resumeProducing()
            await bench.wait_for(lambda: len(target.data) == len(data))
            assert target.data == data

    flown(fly)


def unsent(peer):
    transport = peer.transport
    waiting = len(transport.dataBuffer) - transport.offset
    return waiting + sum(map(len, transport._tempDataBuffer))


def test_a_reset_is_forwarded():
    async def fly():
        async with Bench(LinkSettings(delay_ms=10), LinkSettings(delay_ms=10)) as bench:
            client, target = await bench.pair()
            target.transport.abortConnection()
            await bench.pass_s(0.05)
            await until(lambda: client.is_lost)
            assert client.was_aborted

    flown(fly)


def test_a_refused_connection_is_closed():
    async def fly():
        async with Bench(LinkSettings(delay_ms=10), LinkSettings(delay_ms=10)) as bench:
            await bench.listener.stopListening()
            client = await bench.client()
            client.send(b"data")
            await bench.pass_s(0.005)
            assert not client.is_lost
            await bench.wait_for(lambda: client.is_lost)
            assert not bench.relay.connections

    flown(fly)


def test_stopping_ends_all_connections():
    async def fly():
        bench = Bench(LinkSettings(delay_ms=10))
        async with bench:
            client, target = await bench.pair()
            client.send(pattern(100_000, 1))
            await bench.pass_s(0.001)
            black_out(bench)
            await bench.client()
            bench.up.stall()
            await turn()
        assert not bench.relay.connections
        assert client.is_lost and target.is_lost

    flown(fly)


def test_a_port_in_use_is_reported():
    async def fly():
        first = LinkRelay(reactor, 0, "127.0.0.1", 1, LinkModel(), LinkModel())
        taken = first.start()
        with pytest.raises(LinkRelayError, match=f"127.0.0.1:{taken}") as caught:
            LinkRelay(reactor, taken, "127.0.0.1", 1, LinkModel(), LinkModel()).start()
        assert caught.value.code == "port_in_use" and "\n" not in str(caught.value)
        await first.stop()

    flown(fly)
