"""`python main.py` as a process, and a ground station that sends Commands to it."""

import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path

from tests.support.waiting import DEADLINE_S, until

ROOT = Path(__file__).parents[3]
CONFIG = {
    "mission_control.yml": "role: pilot\nlistener: {port: 0, address: 127.0.0.1}\n",
    "android.yml": "general port: 0\norientation port: 0\n",
    "discovery.yml": "port: 0\n",
}


class Daemon:
    """Raspilot with a configuration of the test's, on its own ports."""

    def __init__(self, folder, port, **files):
        self.folder = folder / "config"
        self.folder.mkdir(exist_ok=True)
        self.log = folder / "daemon.log"
        self.process = None
        self.ground = None
        texts = {**CONFIG, "arduino.yml": f"port: {port}\n"}
        texts.update((f"{name}.yml", text) for name, text in files.items())
        for name, text in texts.items():
            (self.folder / name).write_text(text, encoding="utf-8")

    def start(self):
        """Start it and let a ground station command it."""
        with self.log.open("ab") as output:
            start = output.tell()
            self.process = subprocess.Popen(
                [sys.executable, str(ROOT / "main.py"), "--config", str(self.folder)],
                stdout=output,
                stderr=subprocess.STDOUT,
                cwd=ROOT,
                env={**os.environ, "UP_LOG_FORMAT": "json"},
            )
        found = until(lambda: self._port(start), "the ground's port in the log")
        self.ground = Ground(int(found[1]))
        return self.ground

    def _port(self, start):
        assert self.process.poll() is None, self.said()
        return re.search(r"ground listens on port (\d+)", self.said()[start:])

    def said(self):
        return self.log.read_text(encoding="utf-8")

    def logged(self, *codes):
        """Return the fields of every log line with one of these codes."""
        lines = [line for line in self.said().splitlines() if line.startswith("{")]
        fields = [json.loads(line).get("fields", {}) for line in lines if line.endswith("}")]
        return [each for each in fields if each.get("code") in codes]

    def end(self, number=signal.SIGTERM):
        """End it and return its exit status."""
        if self.ground is not None:
            self.ground.end()
            self.ground = None
        if self.process is None:
            return None
        with suppress(ProcessLookupError):
            self.process.send_signal(number)
        status = self.process.wait(30)
        self.process = None
        return status


class Ground:
    """A ground station: the newest telemetry, and Commands with their answers."""

    def __init__(self, port):
        self.data = {}
        self.frames = 0
        self.beacon = None
        self.messages = []
        self._asked = 0
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=DEADLINE_S)
        self._say(b"UP1 aircraft=default\n")
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def end(self):
        with suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._thread.join(DEADLINE_S)
        self._socket.close()

    def ask(self, name, **data):
        """Send a Command and return '' for its ack, else the detail or the code of its nack."""
        self._asked += 1
        id_ = f"ask-{self._asked}"
        message = {"name": name, "data": data, "id": id_, "beacon": self.beacon}
        self._say(json.dumps(message).encode() + b"\n")

        def answer():
            answers = [each for each in self.messages if each["name"] in ("up.ack", "up.nack")]
            return next((each for each in answers if each["data"]["id"] == id_), None)

        data = until(answer, f"the answer to {name}")["data"]
        return data.get("detail") or data.get("code", "")

    def content(self, name):
        """Return the data of the newest message of a name."""
        found = until(lambda: [each for each in self.messages if each["name"] == name], name)
        return found[-1]["data"]

    def sees(self, what, **wanted):
        """Wait until telemetry shows values at dotted keys (written with two underscores)."""

        def is_so():
            return all(self.at(key.replace("__", ".")) == value for key, value in wanted.items())

        try:
            until(is_so, what)
        except AssertionError:
            raise AssertionError(f"never came: {what}; telemetry: {self.data}") from None

    def comes(self, path, wanted, tolerance):
        """Wait until telemetry shows a number near the wanted one."""

        def is_near():
            value = self.at(path)
            return value is not None and abs(value - wanted) <= tolerance

        try:
            until(is_near, path)
        except AssertionError:
            raise AssertionError(f"{path} is {self.at(path)}, never near {wanted}") from None

    def at(self, path):
        """Return telemetry at a dotted key."""
        found = self.data
        for key in path.split("."):
            found = found.get(key) if isinstance(found, dict) else None
        return found

    def _say(self, line):
        self._socket.sendall(line)

    def _read(self):
        with suppress(OSError), self._socket.makefile("rb") as lines:
            for line in lines:
                if not line.startswith(b"{"):
                    continue
                message = json.loads(line)
                if message["name"] == "up.telemetry.update":
                    self.data, self.beacon = message["data"], message["beacon"]
                    self.frames += 1
                else:
                    self.messages.append(message)
