"""The pty: open to every process, never blocking, its link made and removed."""

import fcntl
import os
import select
import stat
import struct
import subprocess
import sys
import termios
import time

import pytest

from up_rig.pty_line import PtyLine, PtyLineError

TIOCGEXCL = 0x80045440


@pytest.fixture
def line():
    made = PtyLine()
    yield made
    made.close()


def opened(line):
    return os.open(line.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)


def read_all(file):
    """Return the received bytes until a short silence, at least one byte."""
    found = b""
    while select.select([file], [], [], 0.05 if found else 20.0)[0]:
        found += os.read(file, 65536)
    return found


def fill(line):
    """Write 600 messages without a reader, each with the reader's side before the next."""
    for number in range(600):
        waiting, dropped = line._unread(), line.dropped
        line.write(b"%08d" % number)
        expected = 8 if line.dropped > dropped else waiting + 8
        deadline = time.monotonic() + 20.0
        while line._unread() != expected:
            assert time.monotonic() < deadline, (line._unread(), expected)


def test_bytes_go_both_ways_unchanged(line):
    everything = bytes(range(256))
    file = opened(line)
    os.write(file, everything)
    assert line.read(20.0, 4096) == everything
    line.write(everything)
    assert read_all(file) == everything
    os.close(file)


def test_it_is_raw_again_for_the_next_who_opens_it(line):
    for _ in range(2):
        file = opened(line)
        assert not termios.tcgetattr(file)[3] & (termios.ECHO | termios.ICANON)
        os.close(file)


def test_without_a_reader_it_drops_and_never_blocks(line):
    fill(line)
    assert line.dropped > 300
    before = line.dropped
    for _ in range(10_000):
        line.write(b"burst of 10,000 " * 16)
    assert line.dropped > before


def test_a_reader_that_comes_back_gets_what_is_new(line):
    returned = []
    line.returned = lambda: returned.append(True)
    fill(line)
    file = opened(line)
    assert read_all(file) == b"00000599"
    dropped = line.dropped
    line.write(b"hello again")
    assert returned == [True]
    assert read_all(file) == b"hello again"
    assert line.dropped == dropped
    os.close(file)


def test_a_reader_may_come_and_go(line):
    for _ in range(3):
        file = opened(line)
        line.write(b"hello")
        assert read_all(file) == b"hello"
        os.close(file)
        line.read(0.0, 4096)


def is_exclusive(file):
    return struct.unpack("i", fcntl.ioctl(file, TIOCGEXCL, bytes(4)))[0] == 1


def test_who_claimed_the_line_and_left_shuts_nobody_out(line):
    for _ in range(2):
        file = opened(line)
        fcntl.ioctl(file, termios.TIOCEXCL)
        assert is_exclusive(file)
        os.write(file, b"\0")
        line.read(20.0, 4096)
        assert not is_exclusive(file)
        os.close(file)
    file = opened(line)
    fcntl.ioctl(file, termios.TIOCEXCL)
    fill(line)
    assert not is_exclusive(file)
    os.close(file)


def test_the_link_leads_to_the_pty_and_goes_with_it(tmp_path):
    link = tmp_path / "board"
    line = PtyLine(link)
    assert line.path == str(link)
    assert stat.S_ISCHR(link.stat().st_mode)
    assert str(link.readlink()) == line.name
    line.close()
    assert not link.is_symlink()


def test_an_old_link_is_replaced(tmp_path):
    link = tmp_path / "board"
    link.symlink_to("/nowhere")
    line = PtyLine(link)
    assert str(link.readlink()) == line.name
    line.close()


def test_a_link_that_another_board_has_taken_stays(tmp_path):
    link = tmp_path / "board"
    first = PtyLine(link)
    second = PtyLine(link)
    first.close()
    assert str(link.readlink()) == second.name
    second.close()
    assert list(tmp_path.iterdir()) == []


def test_a_file_in_the_way_is_left_alone(tmp_path):
    link = tmp_path / "board"
    link.write_text("precious")
    with pytest.raises(PtyLineError) as caught:
        PtyLine(link)
    assert caught.value.code == "not_a_link"
    assert link.read_text() == "precious"


def test_a_link_that_cannot_be_made(tmp_path):
    with pytest.raises(PtyLineError) as caught:
        PtyLine(tmp_path / "missing" / "board")
    assert caught.value.code == "no_link"


def test_the_line_of_another_process_that_runs_is_left_alone(tmp_path):
    link = tmp_path / "board"
    hold = (
        "import sys; from pathlib import Path; from up_rig.pty_line import PtyLine\n"
        "line = PtyLine(Path(sys.argv[1])); print('open', flush=True); sys.stdin.read()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", hold, link], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as other:
        assert other.stdout.readline() == "open\n"
        name = link.readlink()
        with pytest.raises(PtyLineError) as caught:
            PtyLine(link)
        assert caught.value.code == "in_use"
        assert link.readlink() == name
        # What ends without a word leaves a link that leads nowhere.
        other.kill()
        other.wait()
        line = PtyLine(link)
        assert str(link.readlink()) == line.name
        line.close()
