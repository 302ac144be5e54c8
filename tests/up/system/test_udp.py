import gc
import socket
from itertools import pairwise

import pytest
from twisted.internet.error import CannotListenError
from twisted.internet.protocol import DatagramProtocol

from tests.support.reactor import reactor, run_in_reactor, until
from tests.up.commands.samples import Log
from up.system.udp import MAX_DATAGRAMS_PER_TURN, listen_udp


async def test_a_free_port_is_opened_where_it_is_asked_for():
    port = listen_udp(reactor, 0, DatagramProtocol(), "127.0.0.1")
    host = port.getHost()
    assert host.host == "127.0.0.1"
    assert host.port > 0
    await port.stopListening()


def test_a_port_in_use_is_refused_and_leaves_no_socket():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        number = taken.getsockname()[1]
        with pytest.raises(CannotListenError, match=str(number)):
            listen_udp(reactor, number, DatagramProtocol(), "127.0.0.1")
    gc.collect()


class Hungry(DatagramProtocol):
    """Sends itself another empty datagram for each that comes."""

    def __init__(self):
        self.count = 0

    def datagramReceived(self, datagram, addr):  # noqa: N802 - Twisted's name
        self.count += 1
        if self.count < 10 * MAX_DATAGRAMS_PER_TURN:
            self.transport.write(b"", addr)
        if self.count == 1:
            raise RuntimeError("costs this datagram alone")


def test_a_flood_of_empty_datagrams_leaves_the_reactor_to_others():
    async def listen():
        hungry = Hungry()
        port = listen_udp(reactor, 0, hungry, "127.0.0.1")
        number = port.getHost().port
        hungry.transport.write(b"", ("127.0.0.1", number))
        counts = [0]

        def note():
            counts.append(hungry.count)
            if counts[-1] < 10 * MAX_DATAGRAMS_PER_TURN:
                reactor.callLater(0, note)

        note()
        await until(lambda: counts[-1] == 10 * MAX_DATAGRAMS_PER_TURN)
        await port.stopListening()
        assert max(later - count for count, later in pairwise(counts)) == MAX_DATAGRAMS_PER_TURN

    with Log() as log:
        run_in_reactor(listen)
    assert len(log.failures) == 1
