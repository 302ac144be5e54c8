"""Messages to NATS through the poller."""

import socket
from contextlib import ExitStack, asynccontextmanager, contextmanager, suppress
from itertools import pairwise
from unittest.mock import Mock

import pytest
from twisted.internet.defer import Deferred
from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.error import ConnectionDone
from twisted.internet.protocol import Factory, Protocol
from twisted.internet.task import deferLater
from twisted.internet.threads import deferToThread
from twisted.logger import capturedLogs
from twisted.python.failure import Failure

from tests.support.reactor import reactor
from tests.support.waiting import DEADLINE_S
from up_proxy.cluster.poller_reactor import PollerReactor
from up_proxy.poller import Poller

MESSAGES = [b"%d " % number * 20_000 for number in range(100)]


@contextmanager
def polling():
    poller = Poller(reactor, reactor.seconds)
    poller.start()
    try:
        yield poller
    finally:
        poller.stop()


@asynccontextmanager
async def connected():
    """Yield a poller, a transport, what writes to it, and its peer."""
    with polling() as poller:
        own = PollerReactor(reactor, poller)
        with socket.create_server(("127.0.0.1", 0)) as server:
            endpoint = TCP4ClientEndpoint(own, "127.0.0.1", server.getsockname()[1])
            protocol = await endpoint.connect(Factory.forProtocol(Protocol))
            peer, _ = server.accept()
        await deferLater(reactor, 0)  # out of the write that connected
        with peer:
            yield poller, protocol.transport, own.attach(protocol.transport, lambda _: None), peer


def read_all(peer):
    peer.settimeout(DEADLINE_S)
    return deferToThread(lambda: b"".join(iter(lambda: peer.recv(65536), b"")))


async def test_a_server_that_does_not_read_gets_all_later_and_in_order():
    async with connected() as (_, transport, write, peer):
        early = b""
        for message in MESSAGES:
            write(message)
            if transport.dataBuffer:
                # The socket has room again before the reactor writes what waits.
                with suppress(BlockingIOError):
                    early += peer.recv(2**20, socket.MSG_DONTWAIT)
        transport.loseConnection()
        assert early + await read_all(peer) == b"".join(MESSAGES)


class Ready:
    """Sockets that are all ready at the same time; each calls `handle` with its number, once."""

    def __init__(self, stack, poller, count, handle):
        self.handle, self.left, self.done = handle, count, Deferred()
        for number in range(count):
            here, there = map(stack.enter_context, socket.socketpair())
            here.send(b"x")
            poller.watch(there.fileno(), _One(self, number, there))
            stack.callback(poller.discard, there.fileno())


class _One:
    def __init__(self, ready, number, own):
        self.ready, self.number, self.own = ready, number, own

    def on_ready(self, events):
        self.own.recv(1)
        self.ready.handle(self.number)
        self.ready.left -= 1
        if not self.ready.left:
            reactor.callLater(0, self.ready.done.callback, None)

    def fail(self, reason):
        self.ready.done.errback(AssertionError(reason))


async def test_what_32_events_write_leaves_together_in_order():
    """So none waits for more than 31 other events; nothing waits outside of events."""
    handled, pieces = [], []

    def handle(number):
        # The 51st does not wait for what follows.
        handled.append(b"%02d" % number * (10_000 if len(handled) == 50 else 1))
        write(handled[-1])

    with polling() as poller, ExitStack() as stack:
        transport = Mock(write=pieces.append)
        write = PollerReactor(reactor, poller).attach(transport, lambda _: None)
        await Ready(stack, poller, 70, handle).done
        handle(70)
    edges = [0, 32, 50, 51, 64, 70, 71]
    assert pieces == [b"".join(handled[begin:end]) for begin, end in pairwise(edges)]


async def test_a_server_that_does_not_read_gets_what_events_write_later_and_in_order():
    handled = []

    def handle(number):
        data = b"%d " % number * 4_000  # it waits for others
        handled.append(data)
        write(data)

    async with connected() as (poller, transport, write, peer):
        transport.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 16384)
        peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 16384)
        with ExitStack() as stack:
            await Ready(stack, poller, 100, handle).done
        assert transport.dataBuffer
        transport.loseConnection()
        assert await read_all(peer) == b"".join(handled)


@pytest.mark.parametrize("end", ["connectionLost", "abortConnection"])
async def test_what_waits_for_a_connection_that_ends_meanwhile_ends_with_it(end):
    handled = []

    def handle(number):
        write(b"lost")
        if number == 1:
            how = [Failure(ConnectionDone())] if end == "connectionLost" else []
            getattr(transport, end)(*how)
        handled.append(number)

    async with connected() as (poller, transport, write, peer):
        descriptor = transport.fileno()
        with ExitStack() as stack, capturedLogs() as logs:
            ready = Ready(stack, poller, 3, handle)
            poller.doRead()
            assert descriptor not in poller._handlers
            await ready.done
        with suppress(ConnectionResetError):
            assert await read_all(peer) == b""
    assert sorted(handled) == [0, 1, 2]
    assert [each for each in logs if "log_failure" in each] == []
