"""The listening socket."""

import socket

import pytest

from up_proxy.listener import SEND_BUFFER_BYTES, StartError, listen


def option(sock, name):
    return sock.getsockopt(socket.IPPROTO_TCP, name)


def test_accepted_sockets_inherit_the_options():
    with listen("test port", "127.0.0.1", 0, 1500) as listener:
        peer = socket.create_connection(listener.getsockname())
        listener.setblocking(True)
        accepted, _ = listener.accept()
        with peer, accepted:
            assert option(accepted, socket.TCP_NODELAY) == 1
            assert option(accepted, socket.TCP_USER_TIMEOUT) == 1500
            assert option(accepted, socket.TCP_KEEPIDLE) == 5
            assert accepted.getsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE) == 1
            buffer = accepted.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF)
            assert SEND_BUFFER_BYTES <= buffer <= 2 * SEND_BUFFER_BYTES


def test_an_address_of_another_machine_cannot_be_listened_on():
    with pytest.raises(StartError) as error:
        listen("test port", "203.0.113.1", 0, 1500)
    assert error.value.code == "cannot_listen"
