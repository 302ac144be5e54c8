"""The programs on servers: the Ground Station Proxy and the runner."""

from __future__ import annotations

import re
import signal
import sys
from collections.abc import Sequence
from pathlib import Path

from up_simulator.harness.child import Child
from up_simulator.harness.participants import CrewError

START_LIMIT_S = 30.0


class _Server:
    """A program that prints the port on which it listens."""

    NAME = ""
    MODULE = ""

    def __init__(self, config: Path, folder: Path) -> None:
        self._command = [sys.executable, "-m", self.MODULE, "--config", str(config)]
        self._folder = folder
        self._child: Child | None = None

    @property
    def pid(self) -> int | None:
        """Return its process number while it runs."""
        child = self._child
        return child.pid if child is not None and child.poll() is None else None

    @property
    def log(self) -> Sequence[str]:
        """Return the newest lines that it logged."""
        return [] if self._child is None else self._child.lines()

    def begin(self) -> None:
        """Start its process without waiting."""
        self._child = Child(self.NAME, self._command, self._folder)

    def check(self) -> None:
        """Raise ``CrewError`` with its last log lines if it has ended unexpectedly."""
        if self._child is not None and (status := self._child.poll()) is not None:
            raise CrewError(self._child.last_words(status))

    def kill(self) -> None:
        """Kill it immediately by ``kill -9``."""
        if self._child is not None:
            self._child.signal(signal.SIGKILL)
            self._child.wait()
            self._child = None

    def stop(self) -> None:
        """Send it the signal to end and wait for it."""
        if self._child is not None:
            self._child.end()
            self._child = None

    def _port(self, words: str) -> int:
        if self._child is None:
            raise CrewError(f"the {self.NAME} does not run")
        line = self._child.wait_for_line(words, START_LIMIT_S)
        found = re.search(re.escape(words) + r"(\d+)", line)
        if found is None:
            raise CrewError(f"the {self.NAME} names no port: {line}")
        return int(found[1])


class RealProxy(_Server):
    """``up-proxy --config DIR``; ``start`` waits for its ports."""

    NAME, MODULE = "proxy", "up_proxy.main"

    def start(self) -> None:
        """Start it; raises ``CrewError`` with its own words when it does not listen."""
        self.begin()
        self.airborne_port = self._port("airborne side listens on port ")
        self.ground_port = self._port("ground side listens on port ")


class RealRunner(_Server):
    """``up-runner --config DIR``; ``start`` waits for its port.

    Its instances end with it if ``runner.yml`` has ``stop instances on exit: true``.
    """

    NAME, MODULE = "runner", "up_runner.main"

    def start(self) -> None:
        """Start it; raises ``CrewError`` with its own words when it does not listen."""
        self.begin()
        self.port = self._port("listens on port ")
