"""The Java phone and the Java ground console at the real daemon: every socket a real one."""

import json
import os
import signal
import time

import pytest

from tests.simulator.bench import StillFlight
from tests.support.java import CONSOLE, java_program
from up_simulator.aircraft.truth import TOPIC, record_of
from up_simulator.harness.child import Child
from up_simulator.harness.ports import choose_port_sets
from up_simulator.harness.programs import RealRaspilot
from up_simulator.phone.java_handset import JavaHandset

LIMIT_S = 60.0
PERIOD_S = 0.02


class Clock:
    seconds = staticmethod(time.monotonic)


class Console:
    """The ground console on its own JVM."""

    def __init__(self, program, folder, port):
        options = ["--direct", f"127.0.0.1:{port}", "--values", "altitude,orientation.roll"]
        command = program.command(*options, main=CONSOLE)
        self.child = Child("console", command, folder, is_piped=True)
        os.set_blocking(self.child.output.fileno(), False)
        self.unread = b""
        self.frames = []

    def receive(self):
        self.unread += self.child.output.read() or b""
        *lines, self.unread = self.unread.split(b"\n")
        for line in map(json.loads, lines):
            if line["event"] == "telemetry":
                self.frames.append(line)

    def close(self):
        self.child.input.close()
        self.child.output.close()
        self.child.wait()


class System:
    """The daemon without a board, a phone that lies on a still flight, and a ground."""

    def __init__(self, program, folder):
        (ports,) = choose_port_sets(1)
        config = folder / "config"
        config.mkdir()
        for name, text in {
            "config": "mode: flight controller\n",
            "arduino": f"port: {folder / 'no-board'}\n",
            "android": f"general port: {ports.general}\norientation port: {ports.orientation}\n",
            "discovery": f"port: {ports.discovery}\n",
            "black_box": f"folder: {folder / 'flights'}\n",
            "mission_control": f"listener: {{port: {ports.ground}, address: 127.0.0.1}}\n",
        }.items():
            (config / f"{name}.yml").write_text(text)
        self.logged = []
        self.flight = StillFlight()
        self.daemon = RealRaspilot(config, folder)
        place = ["--raspberry", f"127.0.0.1:{ports.general}:{ports.orientation}"]
        self.phone = JavaHandset(
            program, Clock, self.flight, lambda: place, "tcp", self.log,
            seed=3, record=record_of,
        )  # fmt: skip
        self.daemon.start()
        self.daemon.wait_for("started")
        self.phone.start()
        self.console = Console(program, folder, ports.ground)

    def log(self, _text, /, *, code="", **fields):
        self.logged.append((code, fields))

    def until(self, is_done, what):
        deadline_s = time.monotonic() + LIMIT_S
        while not is_done():
            assert time.monotonic() < deadline_s, f"never: {what}; {self.logged} {self.frame}"
            self.phone.tick()
            self.console.receive()
            time.sleep(PERIOD_S)

    @property
    def frame(self):
        return self.console.frames[-1]["values"] if self.console.frames else {}

    def end(self):
        stop = self.phone.stop()
        with pytest.raises(StopIteration):
            stop.send(None)
        self.console.close()
        self.daemon.stop()


@pytest.fixture
def system(tmp_path):
    made = System(java_program(), tmp_path)
    yield made
    made.end()


def test_a_killed_jvm_is_logged_once_and_the_daemon_flies_on(system, tmp_path):
    system.until(lambda: system.frame.get("altitude") is not None, "the phone")
    roll_deg = system.flight.state.roll_deg
    system.until(lambda: abs((system.frame["orientation.roll"] or 0) - roll_deg) < 0.01, "the bank")
    os.kill(system.phone.pid, signal.SIGKILL)
    system.until(lambda: system.phone.pid is None, "the end is noticed")
    (lost,) = [fields for code, fields in system.logged if code == "phone_lost"]
    assert "signal 9" in lost["reason"]
    frames = len(system.console.frames)
    system.until(lambda: len(system.console.frames) > frames + 3, "telemetry continues")
    system.phone.tick()
    assert [code for code, _ in system.logged].count("phone_lost") == 1
    # What its companion had recorded is there.
    (log,) = (tmp_path / "flights").glob("*.mcap")
    assert TOPIC.encode() in log.read_bytes()
