"""The programs on servers: the Ground Station Proxy and the runner."""

from __future__ import annotations

import re
import sys
from pathlib import Path

from up_simulator.crew.child import Child
from up_simulator.crew.protocols import CrewError

START_LIMIT_S = 30.0


class RealProxy:
    """``up-proxy --config DIR``; ``start`` waits for its ports."""

    def __init__(self, config: Path, folder: Path) -> None:
        self._command = [sys.executable, "-m", "up_proxy.main", "--config", str(config)]
        self._folder = folder
        self._child: Child | None = None
        self.airborne_port = 0
        self.ground_port = 0

    def start(self) -> None:
        """Start it; raises ``CrewError`` with its own words when it does not listen."""
        self._child = Child("proxy", self._command, self._folder)
        self.airborne_port = _port_of(self._child, "airborne side listens on port ")
        self.ground_port = _port_of(self._child, "ground side listens on port ")

    def check(self) -> None:
        """Raise ``CrewError`` with its last words when it has ended by itself."""
        _check(self._child)

    def stop(self) -> None:
        """Ask it to end and wait until it has."""
        if self._child is not None:
            self._child.end()
            self._child = None


class RealRunner:
    """``up-runner --config DIR``; it stops its instances when it is stopped.

    The configuration's ``runner.yml`` must say ``stop instances on exit: true``.
    """

    def __init__(self, config: Path, folder: Path) -> None:
        self._command = [sys.executable, "-m", "up_runner.main", "--config", str(config)]
        self._folder = folder
        self._child: Child | None = None
        self.port = 0

    def start(self) -> None:
        """Start it; raises ``CrewError`` with its own words when it does not listen."""
        self._child = Child("runner", self._command, self._folder)
        self.port = _port_of(self._child, "listens on port ")

    def check(self) -> None:
        """Raise ``CrewError`` with its last words when it has ended by itself."""
        _check(self._child)

    def stop(self) -> None:
        """Ask it to end, with what it has spawned, and wait until it has."""
        if self._child is not None:
            self._child.end()
            self._child = None


def _port_of(child: Child, words: str) -> int:
    line = child.wait_for_line(words, START_LIMIT_S)
    found = re.search(re.escape(words) + r"(\d+)", line)
    if found is None:
        raise CrewError(f"{child.name} names no port: {line}")
    return int(found[1])


def _check(child: Child | None) -> None:
    if child is not None and (status := child.poll()) is not None:
        raise CrewError(child.last_words(status))
