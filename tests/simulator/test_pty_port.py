"""The pty: there for everybody who opens it, never blocking, its link made and removed."""

import fcntl
import os
import select
import stat
import struct
import termios
import time

import pytest

from up_simulator.pty_port import PtyLinkError, PtyPort

TIOCGEXCL = 0x80045440


class Reactor:
    """Remembers the readers, so that the test itself says when to read."""

    def __init__(self):
        self.readers = []

    def addReader(self, reader):  # noqa: N802
        self.readers.append(reader)

    def removeReader(self, reader):  # noqa: N802
        self.readers.remove(reader)


@pytest.fixture
def port():
    made = PtyPort(Reactor())
    yield made
    made.close()


def opened(port):
    return os.open(port.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)


def read_all(file):
    """Return what comes until nothing has come for a moment, at least one byte."""
    found = b""
    while select.select([file], [], [], 0.05 if found else 20.0)[0]:
        found += os.read(file, 65536)
    return found


def fill(port):
    """Write 600 messages that nobody reads, each with the reader's side before the next."""
    for number in range(600):
        waiting, dropped = port._unread(), port.dropped
        port.write(b"%08d" % number)
        expected = 8 if port.dropped > dropped else waiting + 8
        deadline = time.monotonic() + 20.0
        while port._unread() != expected:
            assert time.monotonic() < deadline, (port._unread(), expected)


def test_bytes_go_both_ways_unchanged(port):
    everything = bytes(range(256))
    got = []
    port.received = got.append
    file = opened(port)
    os.write(file, everything)
    port.doRead()
    port.write(everything)
    assert b"".join(got) == everything
    assert read_all(file) == everything
    os.close(file)


def test_it_is_raw_again_for_the_next_who_opens_it(port):
    for _ in range(2):
        file = opened(port)
        assert not termios.tcgetattr(file)[3] & (termios.ECHO | termios.ICANON)
        os.close(file)


def test_without_a_reader_it_drops_and_never_blocks(port):
    fill(port)
    assert port.dropped > 300
    before = port.dropped
    for _ in range(10_000):
        port.write(b"burst of 10,000 " * 16)
    assert port.dropped > before


def test_a_reader_that_comes_back_gets_what_is_new(port):
    returned = []
    port.returned = lambda: returned.append(True)
    fill(port)
    file = opened(port)
    assert read_all(file) == b"00000599"
    dropped = port.dropped
    port.write(b"hello again")
    assert returned == [True]
    assert read_all(file) == b"hello again"
    assert port.dropped == dropped
    os.close(file)


def test_a_reader_may_come_and_go(port):
    for _ in range(3):
        file = opened(port)
        port.write(b"hello")
        assert read_all(file) == b"hello"
        os.close(file)
        port.doRead()


def is_exclusive(file):
    return struct.unpack("i", fcntl.ioctl(file, TIOCGEXCL, bytes(4)))[0] == 1


def test_who_claimed_the_line_and_left_shuts_nobody_out(port):
    for _ in range(2):
        file = opened(port)
        fcntl.ioctl(file, termios.TIOCEXCL)
        assert is_exclusive(file)
        os.write(file, b"\0")
        port.doRead()
        assert not is_exclusive(file)
        os.close(file)
    file = opened(port)
    fcntl.ioctl(file, termios.TIOCEXCL)
    fill(port)
    assert not is_exclusive(file)
    os.close(file)


def test_the_link_leads_to_the_pty_and_goes_with_it(tmp_path):
    link = tmp_path / "board"
    port = PtyPort(Reactor(), link)
    assert port.path == str(link)
    assert stat.S_ISCHR(link.stat().st_mode)
    assert str(link.readlink()) == port.name
    port.close()
    assert not link.is_symlink()


def test_an_old_link_is_replaced(tmp_path):
    link = tmp_path / "board"
    link.symlink_to("/nowhere")
    port = PtyPort(Reactor(), link)
    assert str(link.readlink()) == port.name
    port.close()


def test_a_link_that_another_board_has_taken_stays(tmp_path):
    link = tmp_path / "board"
    first = PtyPort(Reactor(), link)
    second = PtyPort(Reactor(), link)
    first.close()
    assert str(link.readlink()) == second.name
    second.close()
    assert list(tmp_path.iterdir()) == []


def test_a_file_in_the_way_is_left_alone(tmp_path):
    link = tmp_path / "board"
    link.write_text("precious")
    with pytest.raises(PtyLinkError, match="left alone"):
        PtyPort(Reactor(), link)
    assert link.read_text() == "precious"


def test_a_link_that_cannot_be_made_is_one_sentence(tmp_path):
    with pytest.raises(PtyLinkError, match="No such file"):
        PtyPort(Reactor(), tmp_path / "missing" / "board")
