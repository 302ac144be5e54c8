"""A small aircraft for the ground station's tests, and `up-ground` as users start it."""

import contextlib
import json
import os
import socket
import subprocess
import sys
import threading
from pathlib import Path

from tests.support.waiting import DEADLINE_S, until

UP_GROUND = Path(sys.executable).with_name("up-ground")
NAME = "default"
"""The aircraft of the running test: the fixture `proxy` gives each test its own."""


def frame(**more):
    return {
        "orientation": {"roll": 12.5, "pitch": -3.25, "yaw": 271.0},
        "rates": {"roll": 1.0, "pitch": 2.0, "yaw": 3.0},
        "rx": {"ailerons": 1500, "elevator": 1200, "throttle": 1000, "rudder": 1800},
        "servo": {"ailerons": 1511, "elevator": 1222, "throttle": 1000, "rudder": 1833},
        "location": {"latitude": 50.0755, "longitude": 14.4378, "altitude": 312.0},
        "home": {"latitude": 50.07, "longitude": 14.4, "altitude": 210.0,
                 "distance": 1204.0, "bearing": 271.0},
        "altitude": 311.4,
        "heading": {"actual": 88.0, "required": 90.0},
        "android": {"connected": True, "batteryLevel": 83},
        "arduino": {"connected": True, "framing": "checked", "switch": "AUTO", "failsafe": False},
        "load": {"cpu": 12.0, "ram": 31.0, "panic": False, "delay_ms": 100},
        "mode": "flight controller",
        "flight_mode": "FBW",
        "flight_controller": "arduino",
        "armed": False,
        "vetoes": [],
        "age_ms": {"orientation": 12, "rx": 20, "servo": 20, "location": 600, "altitude": 30,
                   "heading": 40, "battery": 20000},
        "source": {"orientation": "arduino", "location": "android"},
        **more,
    }  # fmt: skip


class Aircraft:
    """Sends telemetry every 30 ms and answers Commands as a test defines.

    `answers` maps a Command's name to a function of its message that returns (name, data) pairs;
    a Command without one is acked.
    """

    def __init__(self, port, answers=None, data=None, hello=None):
        self.received = []
        self.data = data or frame()
        self.is_quiet = False
        self.beacon = 4711
        self._answers = answers or {}
        self._ended = threading.Event()
        self._lock = threading.Lock()
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=DEADLINE_S)
        self.send(f"UP1 aircraft={NAME}\n".encode() if hello is None else hello)
        self._threads = [
            threading.Thread(target=each, daemon=True) for each in (self._read, self._tell)
        ]
        for thread in self._threads:
            thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._ended.set()
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        for thread in self._threads:
            thread.join(DEADLINE_S)
        self._socket.close()

    def send(self, line):
        with self._lock, contextlib.suppress(OSError):
            self._socket.sendall(line)

    def tell(self, name, data, **more):
        self.send((json.dumps({"name": name, "data": data, **more}) + "\n").encode())

    def _tell(self):
        while not self._ended.wait(0.03):
            if self.is_quiet:
                self.send(b"\n")
            else:
                self.beacon += 1
                self.tell("up.telemetry.update", self.data, beacon=self.beacon)

    def _read(self):
        with self._socket.makefile("rb") as file, contextlib.suppress(OSError):
            for line in file:
                if line.startswith(b"{"):
                    self._on_command(json.loads(line))

    def _on_command(self, message):
        self.received.append(message)
        answer = self._answers.get(message["name"])
        if answer is None:
            self.tell("up.ack", {"id": message["id"]})
        else:
            for name, data in answer(message):
                self.tell(name, data)


def environment(folder, port, **more):
    return {
        **{key: value for key, value in os.environ.items() if not key.startswith("UP_GROUND_")},
        "XDG_STATE_HOME": str(folder / "state"),
        "UP_GROUND_PORT": str(port),
        "UP_GROUND_AIRCRAFT": NAME,
        "UP_LOG_FORMAT": "json",
        "PYTHONWARNINGS": "error",
        **more,
    }


def coded(text):
    """Return the fields of the lines that have a code, one dictionary each."""
    return [json.loads(line)["fields"] for line in text.splitlines() if '"fields": {"code"' in line]


def codes(text):
    return [each["code"] for each in coded(text)]


def ground(folder, port, *arguments, **more):
    """Run up-ground to its end and return (status, stdout, stderr)."""
    done = subprocess.run(
        [str(UP_GROUND), *arguments],
        env=environment(folder, port, **more),
        capture_output=True,
        text=True,
        timeout=DEADLINE_S,
    )
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout, done.stderr


class Ground:
    """A running up-ground; `said` and `stderr` grow while it runs."""

    def __init__(self, folder, port, *arguments):
        self.said = ""
        self.stderr = ""
        self.process = subprocess.Popen(
            [str(UP_GROUND), *arguments],
            env=environment(folder, port),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self._threads = [
            threading.Thread(target=self._read, args=pair, daemon=True)
            for pair in ((self.process.stdout, "said"), (self.process.stderr, "stderr"))
        ]
        for thread in self._threads:
            thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
        self.wait()

    def wait(self):
        status = self.process.wait(DEADLINE_S)
        for thread in self._threads:
            thread.join(DEADLINE_S)
        self.process.stdout.close()
        self.process.stderr.close()
        assert "Traceback" not in self.stderr, self.stderr
        return status

    def expect(self, text):
        """Wait until it prints a text, or a line with that code."""
        until(lambda: text in self.said, f"{text!r} in {self.said!r} {self.stderr!r}")

    def event(self, code):
        """Return the fields of the newest printed line with a code; None: there is none."""
        return next((each for each in reversed(coded(self.said)) if each["code"] == code), None)

    def _read(self, pipe, name):
        for line in pipe:
            setattr(self, name, getattr(self, name) + line)
