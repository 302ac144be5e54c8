"""Raspilot as a user runs it, with a phone that sends: stopped, killed, two instances."""

import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from tests.cogs.black_box_cog.flights import codes_in, messages
from tests.proxy.program import until
from up.flight_log.flight_file import flight_files
from up_flightlog.read.flight_log import FlightLog

ROOT = Path(__file__).parents[3]
CONFIG = {
    "config.yml": "mode: black box\n",
    "android.yml": "general port: 0\norientation port: 0\naddress: 127.0.0.1\n",
}


class Aircraft:
    """A daemon in Black Box Mode and its phone."""

    def __init__(self, folder, flights, watched=False, environ=None, **black_box):
        folder.mkdir()
        settings = {"keep free (MB)": 0, **({"folder": str(flights)} if flights else {})}
        files = {**CONFIG, "black_box.yml": json.dumps({**settings, **black_box})}
        for name, text in files.items():
            (folder / name).write_text(text)
        self.notes = folder / "notes"
        command = (
            ["-m", "tests.cogs.black_box_cog.daemon", folder, flights, self.notes]
            if watched
            else ["main.py", "--config", folder]
        )
        self.lines = []
        self.process = subprocess.Popen(
            [sys.executable, *map(str, command)],
            cwd=ROOT,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "UP_LOG_FORMAT": "json", **(environ or {})},
        )
        threading.Thread(target=self._read, daemon=True).start()
        port = self.logged("port_open", name="general")["port"]
        self.phone = socket.create_connection(("127.0.0.1", port))
        self.battery = 0

    def _read(self):
        for line in self.process.stderr:
            self.lines.append(json.loads(line))

    def logged(self, code, **fields):
        """Wait for a line with that code and fields; return its fields."""
        wanted = {"code": code, **fields}.items()
        found = lambda: [  # noqa: E731
            each for line in self.lines if wanted <= (each := line.get("fields", {})).items()
        ]
        return until(found, f"{code} in {self.lines}")[0]

    def speak(self):
        """Send a battery level that was not sent before."""
        self.battery += 1
        data = {"level": self.battery / 10}
        self.phone.sendall(json.dumps({"name": "android.battery", "data": data}).encode() + b"\n")

    def stop(self, number=signal.SIGTERM):
        self.process.send_signal(number)
        status = self.process.wait(30)
        self.phone.close()
        self.process.stderr.close()
        return status


@pytest.fixture
def aircraft(tmp_path):
    running = []

    def start(name="one", flights=tmp_path / "flights", **more):
        running.append(Aircraft(tmp_path / name, flights, **more))
        return running[-1]

    yield start
    for each in running:
        if each.process.poll() is None:
            each.process.kill()
            each.process.wait()


def levels_in(path):
    return [data["level"] for topic, _, data in messages(path) if topic == "android.battery"]


def only_file(folder):
    (found,) = flight_files(folder)
    return found.path


def test_stopped_it_leaves_a_whole_file(aircraft, tmp_path):
    one = aircraft(flights=None, environ={"XDG_STATE_HOME": str(tmp_path)})
    folder = tmp_path / "raspilot" / "flights"
    for _ in range(50):
        one.speak()
    one.logged("recording_started")
    one.speak()
    until(lambda: 5.1 in levels_in(only_file(folder)), "the last word")
    assert one.stop() == 0
    log = FlightLog.read([only_file(folder)])
    assert log.is_complete and not log.problems
    assert log.series("android.battery", "level")[1] == [number / 10 for number in range(1, 52)]
    assert {"config/config.yml", "config/android.yml"} <= set(log.attachments)
    assert log.metadata["flight"]["mode"] == "black box"
    # Without a ground: the recorder requested telemetry.
    assert log.topics["up.telemetry.update"] > 0
    assert "stopping" in codes_in(log.paths[0])


def test_killed_it_leaves_a_file_that_lacks_a_second_at_most(aircraft, tmp_path):
    one = aircraft()
    one.speak()
    one.logged("recording_started")
    path = only_file(tmp_path / "flights")
    said = []
    while len(said) < 100:
        one.speak()
        said.append((time.monotonic(), one.battery / 10))
        time.sleep(0.02)
    until(lambda: levels_in(path)[-1:] and levels_in(path)[-1] > 5, "half of it in the file")
    one.stop(signal.SIGKILL)
    found = FlightLog.read([path])
    assert not found.is_complete
    levels = found.series("android.battery", "level")[1]
    assert levels == [number / 10 for number in range(1, len(levels) + 1)]
    assert len(levels) > 50


def test_a_daemon_without_peers_leaves_no_file(aircraft, tmp_path):
    one = aircraft()
    one.logged("started")
    one.stop()
    assert not (tmp_path / "flights").exists()


def test_the_reactors_thread_never_touches_the_folder(aircraft, tmp_path):
    one = aircraft(watched=True)
    for _ in range(20):
        one.speak()
    one.logged("recording_started")
    one.phone.sendall(b'{"name": "black_box.record", "data": {"topic": "a.b", "content": {}}}\n')
    path = only_file(tmp_path / "flights")
    until(lambda: "a.b" in {topic for topic, _, _ in messages(path)}, "the record")
    assert one.stop() == 0
    notes = [line.split() for line in one.notes.read_text().splitlines()]
    assert {"open", "os.scandir"} <= {event for event, _ in notes}
    assert {thread for _, thread in notes} == {"Thread-BlackBox"}
