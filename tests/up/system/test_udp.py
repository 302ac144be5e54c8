"""UDP ports."""

import gc
import socket

import pytest
from twisted.internet.error import CannotListenError
from twisted.internet.protocol import DatagramProtocol

from tests.support.reactor import reactor, run_in_reactor
from up.system.udp import listen_udp


def test_a_free_port_is_opened_where_it_is_asked_for():
    async def listen():
        port = listen_udp(reactor, 0, DatagramProtocol(), "127.0.0.1")
        host = port.getHost()
        assert host.host == "127.0.0.1"
        assert host.port > 0
        await port.stopListening()

    run_in_reactor(listen)


def test_a_port_in_use_is_refused_and_leaves_no_socket():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        number = taken.getsockname()[1]
        with pytest.raises(CannotListenError, match=str(number)):
            listen_udp(reactor, number, DatagramProtocol(), "127.0.0.1")
    gc.collect()
