"""The line to the board: a socket of this computer alone, or a serial port."""

import socket

import pytest
from msp_cog.config import MSP
from msp_cog.line_opener import open_line

from up.config import ConfigErrors


@pytest.mark.parametrize(
    "port",
    ["tcp:192.168.1.5:5761", "tcp:localhost:5761", "tcp:127.0.0.1", "tcp:127.0.0.1:0",
     "tcp:127.0.0.1:70000", "tcp:[::]:5761", "tcp:"],
)  # fmt: skip
def test_attack_no_line_over_a_network(tmp_path, port):
    """MSP has no keys: a program that reaches it moves the servos."""
    (tmp_path / "msp.yml").write_text(f"port: '{port}'\n")
    with pytest.raises(ConfigErrors) as errors:
        MSP.load(tmp_path)
    assert [problem.key for problem in errors.value.problems] == ["port"]


def test_a_socket_is_opened_and_a_closed_port_is_one_sentence():
    with socket.create_server(("127.0.0.1", 0)) as board:
        port = board.getsockname()[1]
        line = open_line(f"tcp:127.0.0.1:{port}", 115200)
        peer, _ = board.accept()
        with peer, line:
            peer.sendall(b"$M>")
            line.setblocking(True)
            assert line.recv(3) == b"$M>"
    with pytest.raises(OSError, match=str(port)):
        open_line(f"tcp:127.0.0.1:{port}", 115200)
