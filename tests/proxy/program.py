"""The program `up-proxy` as a user starts it, and plain blocking clients for it."""

import json
import os
import signal
import socket
import subprocess
import sys
import threading
from pathlib import Path

from tests.support.waiting import DEADLINE_S, until

UP_PROXY = Path(sys.executable).with_name("up-proxy")


class Program:
    """A running up-proxy; `log` and `events` grow while it runs. Ends it when the test ends."""

    def __init__(
        self,
        folder,
        text="",
        arguments=(),
        ports=(0, 0, 0),
        environ=None,
        prefix=(),
        command=(str(UP_PROXY),),
    ):
        folder.mkdir(exist_ok=True)
        (folder / "proxy.yml").write_text(text, encoding="utf-8")
        command = [*prefix, *command, "--config", str(folder)]
        for option, port in zip(
            ("--airborne-port", "--ground-port", "--metrics-port"), ports, strict=True
        ):
            if port is not None:
                command += [option, str(port)]
        # The last port of the start.
        self.last = "ground" if "metrics: false" in text else "metrics"
        self.log = ""
        self.events = []
        """The fields of each log line."""
        self.process = subprocess.Popen(
            [*command, *arguments],
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "UP_LOG_FORMAT": "json", **(environ or {})},
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stderr:
            self.log += line
            if line.startswith("{"):
                self.events.append(json.loads(line).get("fields", {}))

    def __enter__(self):
        until(self.is_up, f"the start of up-proxy; log {self.log}")
        return self

    def __exit__(self, *_):
        self.end()

    def is_up(self):
        assert self.process.poll() is None or self.events, self.log
        return self._port(self.last)

    def codes(self):
        return [fields.get("code") for fields in self.events]

    def _port(self, side):
        for fields in list(self.events):
            if fields.get("code") == "port_open" and fields["side"] == side:
                return fields["port"]
        return 0

    @property
    def airborne_port(self):
        return self._port("airborne")

    @property
    def ground_port(self):
        return self._port("ground")

    def tls_port(self, side):
        def find():
            ports = [each for each in self.events if each.get("tls") and each["side"] == side]
            return ports and ports[0]["port"]

        return until(find, f"the TLS port; log {self.log}")

    @property
    def metrics_port(self):
        return self._port("metrics")

    @property
    def pid(self):
        return self.process.pid

    def rss_bytes(self):
        pages = int(Path(f"/proc/{self.pid}/statm").read_text(encoding="ascii").split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE")

    def wait(self):
        status = self.process.wait(DEADLINE_S)
        self._reader.join(DEADLINE_S)
        self.process.stderr.close()
        return status

    def end(self, how=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(how)
        return self.wait() if not self.process.stderr.closed else self.process.returncode


class Client:
    """A blocking client that reads lines."""

    def __init__(self, port, first="", host="127.0.0.1"):
        self.socket = socket.create_connection((host, port), timeout=DEADLINE_S)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.file = self.socket.makefile("rb")
        if first:
            self.say(first)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.file.close()
        self.socket.close()

    def say(self, data):
        self.socket.sendall(data.encode("ascii") if isinstance(data, str) else data)
        return self

    def line(self):
        """Return the next line; empty at the end of the connection, however it ended."""
        try:
            return self.file.readline().decode("ascii")
        except ConnectionError:
            return ""

    def expect(self, text):
        """Read lines until one contains `text`; heartbeats and control lines are skipped."""
        while text not in (line := self.line()):
            assert line, f"closed before {text!r} came"
        return line


def accepted(port, hello, host="127.0.0.1"):
    """Return a client whose hello was accepted, and its token."""
    client = Client(port, hello, host)
    answer = client.line()
    assert answer.startswith("UP1 ok "), answer
    return client, answer.split("token=")[1].strip()
