"""The program on a pty, as the daemon meets it."""

import contextlib
import itertools
import os
import select
import signal
import stat
import subprocess
import sys
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.arduino.rig.firmware import build, make_rig
from up_rig.pty_line import PtyLine
from up_rig.real_time import RealTime
from up_rig.sticks import BEFORE, SticksError, read_sticks

DEADLINE_S = 30.0


@contextlib.contextmanager
def program(*arguments):
    process = subprocess.Popen(
        [sys.executable, "-W", "error", "-m", "up_rig", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.fixture
def echo(tmp_path):
    elf = build("serial", tmp_path, "-DCASE=1")
    make_rig(elf)
    return elf


def exchange(path, data):
    """Write bytes and return as many; they are sent again until the chip receives them."""
    file = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    try:
        deadline = time.monotonic() + DEADLINE_S
        while time.monotonic() < deadline:
            os.write(file, data)
            heard = b""
            while len(heard) < len(data) and select.select([file], [], [], 1.0)[0]:
                heard += os.read(file, 4096)
            if heard == data:
                return heard
        raise AssertionError(f"heard {heard!r}")
    finally:
        os.close(file)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_it_answers_on_its_pty_and_ends_cleanly(echo, tmp_path, number):
    link = tmp_path / "board"
    with program(echo, "--pty", "--pty-link", link) as process:
        assert process.stdout.readline() == f"board on {link}\n"
        assert stat.S_ISCHR(link.stat().st_mode)
        assert exchange(link, b"hello\0\x7f\xff") == b"hello\0\x7f\xff"
        assert exchange(link, b"again") == b"again"
        process.send_signal(number)
        assert process.wait(DEADLINE_S) == 0
        assert process.stderr.read() == ""
        assert not link.is_symlink()


@pytest.mark.parametrize(
    "arguments, sentence",
    [
        ([], "which FIRMWARE?"),
        (["missing.elf", "--pty"], "cannot read missing.elf"),
        (["missing.elf"], "say --pty"),
        (["x.elf", "--pty", "--sticks", "flaps=1"], "'flaps=1' is not understood"),
        (["x.elf", "--pty", "--baud", "7"], "a rate is 300 to 1000000"),
    ],
)
def test_wrong_options_get_a_sentence(arguments, sentence):
    with program(*arguments) as process:
        _output, errors = process.communicate(timeout=DEADLINE_S)
        assert process.returncode in (1, 2)
        assert sentence in errors
        assert "Traceback" not in errors


def test_a_file_in_the_links_place_is_left_alone(echo, tmp_path):
    place = tmp_path / "board"
    place.write_text("mine")
    with program(echo, "--pty", "--pty-link", place) as process:
        _output, errors = process.communicate(timeout=DEADLINE_S)
        assert process.returncode == 1
        assert str(place) in errors
        assert place.read_text() == "mine"


def test_the_eeprom_is_kept_between_runs(tmp_path):
    elf, kept = build("resets", tmp_path, "-DCASE=6"), tmp_path / "eeprom.bin"
    make_rig(elf)
    with program(elf, "--pty", "--eeprom", kept) as process:
        path = process.stdout.readline().removeprefix("board on ").strip()
        file = os.open(path, os.O_RDWR | os.O_NOCTTY)
        heard = b""
        while not heard.endswith(b"\x5a\xee"):
            assert select.select([file], [], [], DEADLINE_S)[0]
            heard += os.read(file, 64)
        os.close(file)
        process.terminate()
        process.wait(DEADLINE_S)
    assert kept.read_bytes()[8:12] == b"\xff\xff\x5a\xff"


class Clock:
    def __init__(self):
        self.now_s = 100.0

    def __call__(self):
        return self.now_s


class SilentLine(PtyLine):
    """A line whose waiting moves the clock instead."""

    def __init__(self, clock):
        super().__init__()
        self.clock = clock

    def read(self, timeout_s, most):
        self.clock.now_s += max(timeout_s, 0.0)
        return super().read(0.0, most)


@pytest.fixture
def real_time(tmp_path):
    clock = Clock()
    line = SilentLine(clock)
    rig = make_rig(build("serial", tmp_path, "-DCASE=1"))
    said = []
    made = RealTime(rig, line, read_sticks(BEFORE + " t=2 receiver=off"), said.append, clock)
    yield made, rig, clock, said
    line.close()


def pulses(rig):
    """Spies on the aux2 pulses of the frame in transit."""
    return [each for each in rig.receiver.sent if each.channel == "aux2"]


def test_it_keeps_time_with_the_clock(real_time):
    made, rig, clock, said = real_time
    while clock.now_s < 101.5:
        made.step()
    assert rig.now_us / 1e6 == pytest.approx(clock.now_s - 100.0, abs=0.005)
    assert said == []


def test_missed_time_is_skipped_and_reported(real_time):
    made, rig, clock, said = real_time
    made.step()
    clock.now_s += 3.0
    made.step()
    assert len(said) == 1 and "3.0" in said[0]
    for _ in range(300):
        made.step()
    assert rig.now_us / 1e6 == pytest.approx(clock.now_s - 100.0 - 2.75, abs=0.01)


def test_the_pilot_follows_the_script(real_time):
    made, rig, clock, _said = real_time
    sent = []
    while clock.now_s < 102.5:
        made.step()
        sent += [(each.rise_cycle / 16e6, each.width_cycles // 16) for each in pulses(rig)]
    raised_s = next(rise_s for rise_s, width_us in sent if width_us == 2000)
    assert 1.0 <= raised_s < 1.05
    assert {width_us for rise_s, width_us in sent if rise_s < 0.98} == {1000}
    assert 1.95 < sent[-1][0] < 2.03, "the receiver went off at 2 s"


@given(
    st.lists(
        st.one_of(
            st.text(max_size=12),
            st.tuples(
                st.sampled_from(["t", "aileron", "aux2", "receiver", "throttle", ""]),
                st.sampled_from(["1500", "on", "off", "-1", "1e9", "nan", "9" * 5000, "²", ""]),
            ).map("=".join),
        ),
        max_size=6,
    )
)
def test_any_script_is_read_or_refused_in_one_sentence(words):
    try:
        moves = read_sticks(" ".join(words))
    except SticksError as error:
        assert str(error).startswith("sticks: ")
    else:
        assert all(earlier.time_s <= later.time_s for earlier, later in itertools.pairwise(moves))


@pytest.mark.parametrize("contents", [b"", b"another text", bytes(1025)])
def test_a_file_that_is_no_eeproms_is_never_written(tmp_path, contents):
    elf, other = build("resets", tmp_path, "-DCASE=6"), tmp_path / "other.txt"
    other.write_bytes(contents)
    command = [sys.executable, "-m", "up_rig", str(elf), "--pty", "--eeprom", str(other)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 1
    assert str(other) in done.stderr
    assert "Traceback" not in done.stderr
    assert other.read_bytes() == contents
