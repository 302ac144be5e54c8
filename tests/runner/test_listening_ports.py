"""Ports as the kernel knows them."""

import os
import socket

from up_runner.listening_ports import listening_ports


def test_listeners_and_bound_datagram_sockets_count_connections_do_not():
    with (
        socket.create_server(("127.0.0.1", 0)) as tcp,
        socket.create_server(("::1", 0), family=socket.AF_INET6) as tcp6,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp,
        socket.socket() as bound,
    ):
        udp.bind(("127.0.0.1", 0))
        bound.bind(("127.0.0.1", 0))
        ports = [each.getsockname()[1] for each in (tcp, tcp6, udp)]
        with socket.create_connection(("127.0.0.1", ports[0])) as connection:
            found = listening_ports(os.getpid())
            assert set(ports) <= found
            assert connection.getsockname()[1] not in found
            assert bound.getsockname()[1] not in found
    assert not set(ports) & listening_ports(os.getpid())


def test_another_process_has_its_own():
    with socket.create_server(("127.0.0.1", 0)) as server:
        assert server.getsockname()[1] not in (listening_ports(1) or ())


def test_the_ports_of_a_missing_process_are_unknown():
    assert listening_ports(2**22 + 1) is None
