"""Plain traffic from public addresses, judged when a peer connects."""

import pytest

from tests.proxy.namespace import figure, must, network, python
from tests.proxy.program import Program

PUBLIC = "198.51.100.7"
KNOCK = """
import socket
for port in {ports}:
    with socket.create_connection(("{host}", port), timeout=30) as peer:
        assert peer.getsockname()[0] == "{host}"
        try:
            peer.sendall(b"UP1 aircraft=a\\n")
            print(peer.recv(4096).decode().split("\\n")[0])
        except ConnectionError:
            print("reset")
"""


@pytest.mark.parametrize("accepts", [False, True])
def test_a_public_peer_is_let_in_only_when_plain_traffic_is_accepted(tmp_path, accepts):
    text = "i_accept_plain: true\n" if accepts else ""
    with network() as inside, Program(tmp_path, text, prefix=inside) as proxy:
        must(*inside, "ip", "addr", "add", f"{PUBLIC}/32", "dev", "lo")
        ports = (proxy.airborne_port, proxy.ground_port) * 2
        answers = python(inside, KNOCK.format(ports=ports[: 2 if accepts else 4], host=PUBLIC))
        for answer in answers.splitlines():
            expected = ("UP1 ok ",) if accepts else ("UP1 error code=address ", "reset")
            assert answer.startswith(expected), answers
        counted = figure(inside, proxy, 'up_proxy_refused_total{side="ground",code="address"}')
        assert counted == (0 if accepts else 2)
        private = python(inside, KNOCK.format(ports=ports[:2], host="127.0.0.1"))
        if not accepts:
            assert private.count("UP1 ok ") == 2
        proxy.end()
    assert proxy.codes().count("public_peer_refused") == (0 if accepts else 2)
