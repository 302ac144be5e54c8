"""What a connection costs at IP level, as the kernel counts it."""

import socket
from types import SimpleNamespace

import pytest

from tests.support.waiting import until
from up.protocols.tcp_options import HEADER_BYTES, ip_bytes

MESSAGES, SIZE = 50, 100


@pytest.mark.parametrize(
    ("family", "host", "header"),
    [(socket.AF_INET, "127.0.0.1", HEADER_BYTES), (socket.AF_INET6, "::1", HEADER_BYTES + 20)],
)
def test_payload_headers_and_acknowledgements_count(family, host, header):
    with (
        socket.create_server((host, 0), family=family) as server,
        socket.create_connection(server.getsockname()[:2]) as near,
        server.accept()[0] as far,
    ):
        near.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        peer = SimpleNamespace(host=host)
        transport = SimpleNamespace(getHandle=lambda: near, getPeer=lambda: peer)
        before = ip_bytes(transport)
        assert before is not None
        for _ in range(MESSAGES):
            near.sendall(bytes(SIZE))
            far.recv(SIZE, socket.MSG_WAITALL)
            far.sendall(b"!")
            near.recv(1)
        # Each answer carries the acknowledgement; a late acknowledgement may follow.
        least = MESSAGES * (SIZE + header + 1 + header)
        until(lambda: ip_bytes(transport) - before >= least, "the last segment")
        assert ip_bytes(transport) - before <= least + MESSAGES * header


def test_it_is_not_known_without_a_socket():
    assert ip_bytes(SimpleNamespace(getHandle=lambda: None)) is None
