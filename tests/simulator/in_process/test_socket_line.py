import os

from up_simulator.in_process.raspilot import SocketLine


def test_a_line_passes_bytes_at_once_and_ends_with_a_hang_up():
    line = SocketLine()
    assert line.read(0.0, 10) == b""
    line.write(b"unopened")
    with line.open() as other:
        line.write(b"abc")
        assert os.read(other.fileno(), 10) == b"abc"
        other.send(b"defg")
        assert (line.read(0.0, 3), line.read(0.0, 3)) == (b"def", b"g")
        line.unplug()
        assert not line.is_plugged
        assert os.read(other.fileno(), 10) == b""


def test_opening_a_line_again_hangs_up_on_the_end_before():
    line = SocketLine()
    with line.open() as first, line.open() as second:
        assert os.read(first.fileno(), 10) == b""
        line.write(b"x")
        assert os.read(second.fileno(), 10) == b"x"
        line.cut()
        assert second.fileno() == -1
