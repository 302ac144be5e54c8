"""The programs of the system as one starts them by hand, without ``make run``."""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from tests.support.program_output import AS_JSON, fields_of
from tests.support.waiting import DEADLINE_S, until

ROOT = Path(__file__).parents[1]


class Processes:
    """Programs of one test, with their output in files; ended with it."""

    def __init__(self, folder):
        self.folder = folder
        self.started = []

    def start(self, name, *command, **environment):
        path = self.folder / f"{name}.log"
        with path.open("wb") as output:
            process = subprocess.Popen(
                [sys.executable, *map(str, command)],
                stdout=output,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
                env={**os.environ, **AS_JSON, **environment},
            )
        self.started.append(process)

        def event(code, **wanted):
            """Return the fields of the first log event with this code and these fields, or None."""
            found = fields_of(path.read_text(encoding="utf-8"))
            wanted["code"] = code
            return next((each for each in found if wanted.items() <= each.items()), None)

        return event

    def stop(self):
        for process in reversed(self.started):
            process.terminate()
        for process in self.started:
            process.wait(20)


@pytest.fixture
def processes(tmp_path):
    made = Processes(tmp_path)
    yield made
    made.stop()


@pytest.fixture
def short_folder():
    """A folder whose path leaves room for the name of a Unix socket (107 bytes)."""
    with tempfile.TemporaryDirectory(prefix="up-") as folder:
        yield folder


def test_black_box_flight_through_runner_and_proxy(tmp_path, short_folder, processes):
    """Only the phone flies: it requests a runner, Raspilot is spawned, the ground sees it."""
    config = tmp_path / "config"
    black_box = config / "blackbox"
    black_box.mkdir(parents=True)
    (config / "proxy.yml").write_text("airborne port: 0\nground port: 0\nmetrics port: 0\n")
    proxy = processes.start("proxy", "-m", "up_proxy.main", "--config", config)
    ground = str(until(lambda: proxy("port_open", side="ground"), "proxy")["port"])
    airborne = until(lambda: proxy("port_open", side="airborne"), "proxy")["port"]
    (black_box / "config.yml").write_text("mode: black box\n")
    (black_box / "mission_control.yml").write_text(
        f"remote_server: {{url: 127.0.0.1, port: {airborne}}}\n"
    )
    (config / "runner.yml").write_text(
        f"port: 0\nrun folder: {short_folder}\nstop instances on exit: true\ni_accept_root: true\n"
    )
    runner = processes.start("runner", "-m", "up_runner.main", "--config", config)
    port = until(lambda: runner("port_open"), "runner")["port"]
    phone = processes.start(
        "phone", "-m", "up_simulator", "start", "--no-board", "--orientation", "tcp",
        "--runner", f"127.0.0.1:{port}", "--aircraft-name", "glider-7",
    )  # fmt: skip
    until(lambda: phone("phone_connected"), "phone")
    watch = [sys.executable, "-m", "up_ground.main", "--port", ground, "--aircraft", "glider-7",
             "watch", "--json", "--count", "5"]  # fmt: skip

    def frames():
        result = subprocess.run(
            watch, capture_output=True, text=True, timeout=DEADLINE_S, check=True
        )
        return [json.loads(line)["data"] for line in result.stdout.splitlines()]

    until(lambda: frames()[-1]["source"]["orientation"] == "android", "orientation by the phone")
    newest = frames()[-1]
    assert newest["mode"] == "black box"
    assert newest["flight_controller"] is None
    assert "arduino" not in newest
    assert newest["location"]["latitude"] == pytest.approx(50.0, abs=0.1)
    assert newest["age_ms"]["orientation"] < 1000
    assert newest["android"]["connected"]


def test_provisional_black_box_and_back(tmp_path, processes):
    """Without an Arduino the daemon reports it after 5 s, and recovers when it answers."""
    board = tmp_path / "board"
    (tmp_path / "arduino.yml").write_text(f"port: {board}\n")
    (tmp_path / "android.yml").write_text("general port: 0\norientation port: 0\n")
    (tmp_path / "discovery.yml").write_text("port: 0\n")
    (tmp_path / "mission_control.yml").write_text("listener: {port: 0}\n")
    daemon = processes.start("daemon", ROOT / "main.py", "--config", tmp_path)
    until(lambda: daemon("mode_provisional"), "provisional")
    processes.start(
        "board", "-m", "up_simulator", "start", "--no-phone", "--board", "host",
        "--pty-link", board,
    )  # fmt: skip
    until(lambda: daemon("mode_restored"), "back")
    assert '"traceback"' not in (tmp_path / "daemon.log").read_text(encoding="utf-8")


def test_without_any_port_there_is_nothing_to_run_for(tmp_path):
    import socket

    taken = socket.socket()
    taken.bind(("", 0))
    taken.listen()
    port = taken.getsockname()[1]
    (tmp_path / "arduino.yml").write_text(f"port: {tmp_path / 'nothing'}\n")
    (tmp_path / "android.yml").write_text(f"general port: {port}\norientation port: 0\n")
    (tmp_path / "discovery.yml").write_text("port: 0\n")
    result = subprocess.run(
        [sys.executable, str(ROOT / "main.py"), "--config", str(tmp_path)],
        capture_output=True, text=True, timeout=DEADLINE_S, check=False,
        env={**os.environ, **AS_JSON},
    )  # fmt: skip
    taken.close()
    assert result.returncode == 1
    assert "no_source" in [each.get("code") for each in fields_of(result.stderr)]
