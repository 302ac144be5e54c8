import fcntl
import os
import pty
import re
import signal
import struct
import subprocess
import termios
import threading
import time

import pytest

from tests.ground import aircraft
from tests.ground.aircraft import DEADLINE_S, UP_GROUND, Aircraft, environment, until
from tests.proxy.program import Client

ENTER, LEAVE = b"\x1b[?1049h", b"\x1b[?1049l"


class Screen:
    def __init__(self, folder, port, *arguments):
        self.written = b""
        self.ours, self.theirs = pty.openpty()
        self.resize(80, 24)
        self.before = termios.tcgetattr(self.theirs)
        self.process = subprocess.Popen(
            [str(UP_GROUND), "watch", *arguments],
            env=environment(folder, port, TERM="xterm"),
            stdin=self.theirs,
            stdout=self.theirs,
            stderr=self.theirs,
            start_new_session=True,
            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),
        )
        self.is_reading = threading.Event()
        self.is_reading.set()
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait(DEADLINE_S)
        self.is_reading.set()
        self._ended.set()
        os.close(self.theirs)
        self._thread.join(DEADLINE_S)
        os.close(self.ours)

    def _read(self):
        while True:
            self.is_reading.wait()
            try:
                data = os.read(self.ours, 65536)
            except OSError:
                return
            if not data:
                return
            self.written += data

    def resize(self, columns, rows):
        fcntl.ioctl(self.ours, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def press(self, keys):
        os.write(self.ours, keys)

    def expect(self, text, since=0):
        until(lambda: text in self.text(since), f"{text!r} in {self.text(since)!r}")

    def text(self, since=0):
        return re.sub(rb"\x1b\[[0-9;?]*[A-Za-z]", b"", self.written[since:]).decode("utf-8")

    def ends(self):
        """Wait for the end and return the status; the terminal must be as it was."""
        status = self.process.wait(DEADLINE_S)
        until(lambda: self.written.rstrip().endswith(LEAVE), "the end of the alternate screen")
        assert b"\x1b[?25h" in self.written
        assert termios.tcgetattr(self.theirs) == self.before
        assert b"Traceback" not in self.written
        return status


@pytest.fixture
def screen(proxy, tmp_path):
    with Aircraft(proxy.airborne_port), Screen(tmp_path, proxy.ground_port) as screen:
        screen.expect("roll    +12.5 deg")
        yield screen


def test_q_ends_it_and_the_terminal_is_as_before(screen):
    assert screen.written.startswith(ENTER)
    assert termios.tcgetattr(screen.theirs) != screen.before
    screen.press(b"q")
    assert screen.ends() == 0


def test_control_c_ends_it_and_the_terminal_is_as_before(screen):
    screen.press(b"\x03")
    assert screen.ends() == 130


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_it_and_the_terminal_is_as_before(screen, number):
    screen.process.send_signal(number)
    assert screen.ends() == 130


def test_only_changed_rows_are_painted_at_most_ten_times_a_second(screen):
    begin, start_s = len(screen.written), time.monotonic()
    until(lambda: len(screen.written) > begin + 3000, "more pictures")
    spent_s = time.monotonic() - start_s
    fresh = screen.written[begin:]
    # The first heading stands still, the second row has the age that never does.
    assert fresh.count(b"\x1b[3;1H") == 0
    assert 0 < fresh.count(b"\x1b[2;1H") <= spent_s * 10 + 2


def test_another_size_is_painted_anew(screen):
    since = len(screen.written)
    screen.resize(60, 40)
    screen.expect("SERVOS us", since)
    until(lambda: b"\x1b[40;1H" in screen.written[since:], "the last of forty rows")
    screen.press(b"q")
    assert screen.ends() == 0


def test_a_silent_aircraft_is_said_to_be_silent(proxy, tmp_path):
    with (
        Aircraft(proxy.airborne_port) as aircraft,
        Screen(tmp_path, proxy.ground_port) as screen,
    ):
        screen.expect("roll    +12.5 deg")
        since = len(screen.written)
        aircraft.is_quiet = True
        screen.expect("SILENT age", since)
        screen.press(b"q")
        assert screen.ends() == 0


def test_the_seat_is_asked_for_and_handed_over_by_keys(screen, proxy):
    screen.press(b"c")
    screen.expect("control ours")
    with Client(
        proxy.ground_port, f"UP1 aircraft={aircraft.NAME} seat=listen\nUP1 seat request\n"
    ) as other:
        screen.expect("requests control")
        screen.press(b"g")
        other.expect("UP1 seat command token=")
        screen.expect("control ground")
    screen.press(b"q")
    assert screen.ends() == 0


def test_a_terminal_that_stands_still_does_not_stop_the_station(proxy, tmp_path):
    with (
        Aircraft(proxy.airborne_port),
        Screen(tmp_path, proxy.ground_port, "--seat", "command") as screen,
    ):
        screen.expect("control ours")
        screen.is_reading.clear()
        with Client(proxy.ground_port, f"UP1 aircraft={aircraft.NAME} seat=listen\n") as other:
            other.expect("UP1 seat holder=")
            # Longer than a holder that sends no heartbeat would keep the seat.
            end_s = time.monotonic() + 5
            while time.monotonic() < end_s:
                assert "holder=none" not in other.line()
        screen.is_reading.set()
        since = len(screen.written)
        until(lambda: len(screen.written) > since + 20000, "pictures again")
        screen.press(b"q")
        assert screen.ends() == 0
