"""Messages to NATS through the poller."""

import socket
from contextlib import suppress

from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.protocol import Factory, Protocol
from twisted.internet.threads import deferToThread

from tests.support.reactor import reactor
from tests.support.waiting import DEADLINE_S
from up_proxy.cluster.poller_reactor import PollerReactor
from up_proxy.poller import Poller

MESSAGES = [b"%d " % number * 20_000 for number in range(100)]


async def test_a_server_that_does_not_read_gets_all_later_and_in_order():
    poller = Poller(reactor, reactor.seconds)
    poller.start()
    own = PollerReactor(reactor, poller)
    with socket.create_server(("127.0.0.1", 0)) as server:
        endpoint = TCP4ClientEndpoint(own, "127.0.0.1", server.getsockname()[1])
        protocol = await endpoint.connect(Factory.forProtocol(Protocol))
        peer, _ = server.accept()
    write = own.attach(protocol.transport, lambda _: None)
    early = b""
    for message in MESSAGES:
        write(message)
        if protocol.transport.dataBuffer:
            # The socket has room again before the reactor writes what waits.
            with suppress(BlockingIOError):
                early += peer.recv(2**20, socket.MSG_DONTWAIT)
    protocol.transport.loseConnection()
    with peer:
        peer.settimeout(DEADLINE_S)
        heard = await deferToThread(lambda: b"".join(iter(lambda: peer.recv(65536), b"")))
    poller.stop()
    assert early + heard == b"".join(MESSAGES)
