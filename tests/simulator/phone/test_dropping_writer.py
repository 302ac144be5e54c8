"""A peer that does not read costs no memory."""

import socket

from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.protocol import Factory, Protocol

from tests.support.reactor import reactor, run_in_reactor, until
from up_simulator.phone.link import DroppingWriter

PIECE = bytes(16_384)


def test_data_for_a_stalled_peer_is_dropped_until_it_reads():
    async def scenario():
        with socket.create_server(("127.0.0.1", 0)) as server:
            endpoint = TCP4ClientEndpoint(reactor, "127.0.0.1", server.getsockname()[1])
            factory = Factory.forProtocol(Protocol)
            factory.noisy = False
            protocol = await endpoint.connect(factory)
            peer, _ = server.accept()
            transport = protocol.transport
            valve = DroppingWriter(transport)
            for _ in range(2000):
                valve.write(PIECE)
            waiting = sum(map(len, transport._tempDataBuffer)) + len(transport.dataBuffer)
            dropped = valve.dropped
            assert dropped > 1500
            assert waiting < 8 * 65_536

            peer.setblocking(False)

            def reads_and_takes():
                try:
                    while peer.recv(1 << 20):
                        pass
                except BlockingIOError:
                    pass
                before = valve.dropped
                valve.write(b"x")
                return valve.dropped == before

            await until(reads_and_takes, what="the valve opens again")
            transport.abortConnection()
            peer.close()
            await until(lambda: not transport.connected, what="the connection is gone")

    run_in_reactor(scenario)
