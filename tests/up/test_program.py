"""The whole program in real processes: failures, hangs and requests to stop."""

import json
import os
import queue
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
APPLICATION = ROOT / "tests" / "fixtures" / "apps" / "troubled"
RUN = (
    "import sys, pathlib; from up.program import run_application;"
    "paths = [pathlib.Path(each) for each in sys.argv[1:3]];"
    "sys.exit(run_application(*paths, use_defaults=sys.argv[3:] == ['--defaults']))"
)
DEADLINE_S = 60.0


class Daemon:
    """A running application; its words are read as they come."""

    def __init__(self, trouble="", *arguments, **environ):
        self.text = ""
        self._words = queue.Queue()
        self.process = subprocess.Popen(
            [sys.executable, "-W", "error", "-c", RUN, str(APPLICATION), *arguments],
            cwd=ROOT,
            env={**os.environ, "TROUBLE": trouble, "PYTHONUNBUFFERED": "1", **environ},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stdout:
            self._words.put(line)
        self._words.put(None)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait(DEADLINE_S)
        self._reader.join(DEADLINE_S)
        self.process.stdout.close()

    def expect(self, words):
        """Wait until the program has printed these words."""
        deadline_s = time.monotonic() + DEADLINE_S
        while words not in self.text:
            line = self._words.get(timeout=max(0.1, deadline_s - time.monotonic()))
            assert line is not None, f"ended without {words!r}:\n{self.text}"
            self.text += line

    def events(self, code):
        """Return the log events with a code, of a program that was started with JSON lines."""
        # The text of a module's print may stand in the same line, before or behind an event.
        read = json.JSONDecoder().raw_decode
        events = [
            read(line[line.index('{"') :])[0] for line in self.text.splitlines() if '{"' in line
        ]
        return [each for each in events if each.get("fields", {}).get("code") == code]

    def end(self, number=signal.SIGTERM):
        """Send a signal; return the exit status and how long the end took, s."""
        began_s = time.monotonic()
        if number is not None:
            self.process.send_signal(number)
        status = self.process.wait(DEADLINE_S)
        took_s = time.monotonic() - began_s
        self._reader.join(DEADLINE_S)
        while (line := self._words.get()) is not None:
            self.text += line
        return status, took_s


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_stops_what_was_started_in_reverse_within_two_seconds(number):
    with Daemon() as daemon:
        daemon.expect("modules run")
        status, took_s = daemon.end(number)
        assert status == 0
        assert took_s < 2
        assert "before stops" in daemon.text
        assert "Traceback" not in daemon.text


def test_what_is_no_request_to_end_ends_nothing(tmp_path):
    pid = tmp_path / "raspilot.pid"
    with Daemon(UP_PID_FILE=str(pid)) as daemon:
        daemon.expect("modules run")
        assert pid.read_text() == f"{daemon.process.pid}\n"
        for number in (signal.SIGUSR1, signal.SIGUSR2):
            daemon.process.send_signal(number)
        # An orderly end: neither signal ended it before.
        assert daemon.end()[0] == 0
    assert not pid.exists()


def test_a_module_may_stop_the_program():
    with Daemon("stop by command") as daemon:
        daemon.expect("before stops")
        assert daemon.end(None)[0] == 0


@pytest.mark.parametrize(
    ("trouble", "words"),
    [
        ("construct exit", "SystemExit"),
        ("start", "RuntimeError: trouble: start"),
        ("timer raises", "trouble: timer raises"),
    ],
)
def test_a_module_that_raises_is_named_and_the_rest_runs(trouble, words):
    with Daemon(trouble) as daemon:
        daemon.expect(words)
        daemon.expect("modules run")
        if trouble != "timer raises":
            daemon.expect("arming is refused")
        assert daemon.end()[0] == 0
        assert "before stops" in daemon.text


@pytest.mark.parametrize(
    ("trouble", "code"), [("required", "required_module_failed"), ("no source", "no_source")]
)
def test_a_boot_that_cannot_go_on_ends_with_one_sentence(trouble, code):
    with Daemon(trouble, UP_LOG_FORMAT="json") as daemon:
        status, _ = daemon.end(None)
        assert status == 1
        assert len(daemon.events(code)) == 1
        assert "before stops" in daemon.text


@pytest.mark.parametrize(
    ("trouble", "words", "number"),
    [
        ("start hangs", "troubled starts", signal.SIGTERM),
        ("another thread hears the signal", "a thread hears SIGTERM", None),
    ],
)
def test_a_signal_ends_it_while_a_start_hangs_or_in_another_thread(trouble, words, number):
    with Daemon(trouble) as daemon:
        daemon.expect(words)
        status, took_s = daemon.end(number)
        assert status == 0
        assert took_s < 2
        assert "before stops" in daemon.text


@pytest.mark.parametrize("trouble", ["stop holds", "run holds", "start holds"])
def test_one_signal_ends_a_program_whose_reactor_is_held(trouble):
    with Daemon(trouble) as daemon:
        daemon.expect("modules run" if trouble == "stop holds" else "holding")
        status, _ = daemon.end()
        assert status == 1


def test_a_second_signal_forces():
    with Daemon("stop holds") as daemon:
        daemon.expect("modules run")
        daemon.process.send_signal(signal.SIGTERM)
        daemon.expect("holding")
        assert daemon.end(signal.SIGTERM)[0] == 128 + signal.SIGTERM


def test_the_module_that_blocks_the_event_loop_is_named():
    with Daemon("run holds", UP_LOG_FORMAT="json") as daemon:
        daemon.expect('trouble.hold"')
    assert daemon.events("event_loop_blocked")[-1]["level"] == "error"


def test_blocking_the_event_loop_during_the_start_is_not_an_error():
    with Daemon("start is slow", UP_LOG_FORMAT="json") as daemon:
        daemon.expect("event_loop_blocked")
        daemon.expect('"started"')
        assert daemon.end()[0] == 0
    events = daemon.events("event_loop_blocked")
    assert {each["level"] for each in events} == {"info"}


def test_a_folder_without_configuration_is_refused_unless_the_defaults_are_wanted(tmp_path):
    unfinished = tmp_path / ".pids.yml.0123abcd.tmp"
    unfinished.touch()
    with Daemon("", str(tmp_path)) as daemon:
        assert daemon.process.wait(DEADLINE_S) == 2
        daemon.expect("--defaults")
        assert daemon.text.count(str(tmp_path)) == 1, daemon.text
    with Daemon("", str(tmp_path), "--defaults") as daemon:
        daemon.expect("modules run")
        assert not unfinished.exists(), "what a killed write left"
        daemon.process.terminate()
        assert daemon.process.wait(DEADLINE_S) == 0


class Supervisor:
    """The messages to systemd, on a real socket."""

    def __init__(self, folder):
        self.path = folder / "notify"
        self.heard = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.heard.bind(str(self.path))
        self.words = []

    def environ(self, **more):
        return {"NOTIFY_SOCKET": str(self.path), "WATCHDOG_USEC": "200000", **more}

    def hear(self, timeout_s):
        self.heard.settimeout(timeout_s)
        try:
            self.words.append(self.heard.recv(4096).decode())
        except TimeoutError:
            return None
        return self.words[-1]

    def expect(self, word):
        deadline_s = time.monotonic() + DEADLINE_S
        while not any(word in each for each in self.words):
            assert time.monotonic() < deadline_s, (word, self.words)
            self.hear(1.0)

    def pings_in(self, seconds):
        before = len(self.words)
        end_s = time.monotonic() + seconds
        while time.monotonic() < end_s:
            self.hear(max(0.01, end_s - time.monotonic()))
        return sum("WATCHDOG=1" in each for each in self.words[before:])

    def silence(self, seconds):
        """Wait until no ping came for a while."""
        deadline_s = time.monotonic() + DEADLINE_S
        while self.pings_in(seconds):
            assert time.monotonic() < deadline_s


@pytest.fixture
def supervisor(tmp_path):
    made = Supervisor(tmp_path)
    yield made
    made.heard.close()


def test_the_supervisor_hears_readiness_ports_pings_and_the_end(supervisor):
    with Daemon("port", **supervisor.environ()) as daemon:
        supervisor.expect("READY=1")
        ready = next(i for i, each in enumerate(supervisor.words) if "READY=1" in each)
        assert "X_UP_PORTS=general:4321" in supervisor.words[:ready]
        supervisor.expect("X_UP_PORTS=general:4321 late:99")
        before = sum("WATCHDOG=1" in each for each in supervisor.words)
        while sum("WATCHDOG=1" in each for each in supervisor.words) < before + 3:
            assert supervisor.hear(DEADLINE_S)
        assert daemon.end()[0] == 0
        supervisor.expect("STOPPING=1")


@pytest.mark.parametrize("trouble", ["sick", "healthy raises", "run holds"])
def test_pings_end_when_a_module_is_sick_or_the_reactor_is_held(supervisor, trouble):
    with Daemon(trouble, **supervisor.environ()):
        supervisor.expect("READY=1")
        supervisor.silence(1.0)


def test_readiness_is_not_said_before_the_modules_have_started(supervisor):
    with Daemon("start hangs", **supervisor.environ()) as daemon:
        daemon.expect("troubled starts")
        assert supervisor.pings_in(1.0) > 1
        assert not any("READY=1" in each for each in supervisor.words)
