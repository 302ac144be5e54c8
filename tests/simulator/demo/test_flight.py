"""``make run`` in a terminal: its behaviour when its screen dies."""

import os
import pty
import re
import select
import signal
import subprocess
import sys
import termios
import time
from pathlib import Path

import pytest

DEADLINE_S = 120.0
ENTERS, LEAVES, SHOWS_CURSOR = "\x1b[?1049h", "\x1b[?1049l", "\x1b[?25h"


class Terminal:
    """``make run`` in its own terminal."""

    def __init__(self, folder):
        self.own, self.other = pty.openpty()
        self.before = termios.tcgetattr(self.other)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "up_simulator.demo", "--any-ports", "--folder", str(folder),
             "--board", "auto"],
            stdin=self.other, stdout=self.other, stderr=self.other, start_new_session=True,
            env={**os.environ, "TERM": "xterm"},
        )  # fmt: skip
        self.shown = ""

    def wait_for(self, text):
        """Wait until this is shown, and discard the output up to it; return it."""
        deadline_s = time.monotonic() + DEADLINE_S
        while text not in self.shown:
            if select.select([self.own], [], [], 0.05)[0]:
                self.shown += os.read(self.own, 65536).decode("utf-8", "replace")
            assert self.process.poll() is None, self.shown
            assert time.monotonic() < deadline_s, f"never {text!r}: {self.shown[-3000:]}"
        shown, self.shown = self.shown.split(text, 1)
        return shown + text

    def child(self, word):
        pid = self.process.pid
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii").split()
        for child in children:
            if word in Path(f"/proc/{child}/cmdline").read_bytes().decode():
                return int(child)
        raise AssertionError(f"no child {word}")

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        deadline_s = time.monotonic() + DEADLINE_S
        while self.process.poll() is None:
            if select.select([self.own], [], [], 0.05)[0]:
                os.read(self.own, 65536)
            assert time.monotonic() < deadline_s
        return self.process.returncode


@pytest.fixture
def terminal(tmp_path):
    made = Terminal(tmp_path)
    yield made
    if made.process.poll() is None:
        made.end()
    os.close(made.own)
    os.close(made.other)


def test_a_killed_ground_station_does_not_end_the_flight(terminal):
    started = terminal.wait_for("or with Enter; q closes it.")
    os.write(terminal.own, b"\n")
    terminal.wait_for(ENTERS)
    os.kill(terminal.child("\0watch\0"), signal.SIGKILL)
    said = terminal.wait_for("Ctrl-C: stop all.")
    assert said.index(LEAVES) < said.index("signal 9")
    assert SHOWS_CURSOR in said
    assert not re.search(r"its log|Traceback", said)
    assert termios.tcgetattr(terminal.other) == terminal.before
    assert terminal.child("up_simulator")
    os.kill(terminal.child("\0serve\0"), signal.SIGKILL)
    terminal.wait_for("this starts it again: ")
    state, *command = terminal.wait_for("\n").split()
    assert state.startswith("UP_GROUND_STATE=")
    assert Path(command[0]).name == "up-ground"
    # The same address as before: the pages that are open reconnect.
    listen = re.search(r"http://(127\.0\.0\.1:[0-9]+)", started)[1]
    ground = command[command.index("--port") + 1]
    assert command[1:] == ["serve", "--port", ground, "--listen", listen]
    os.write(terminal.own, b"\n")
    terminal.wait_for(ENTERS)
    terminal.wait_for("online")
    assert terminal.end() == 0
