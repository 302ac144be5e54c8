"""The project's programs as processes: the daemon, the Ground Station Proxy and the runner."""

from __future__ import annotations

import signal
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from up_simulator.harness.child import Child
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.user_log import LogLine

START_LIMIT_S = 30.0


class RealProgram:
    """A program with a configuration folder ``config``; its log is ``<NAME>.log`` in ``folder``.

    ``prefix`` is a command that becomes it. One log has all its runs. Only ``wait_for`` and
    ``stop`` wait.
    """

    NAME = ""
    PROGRAM: tuple[str, ...] = ()
    DEATH_SIGNAL = signal.SIGTERM

    def __init__(self, config: Path, folder: Path, prefix: Sequence[str] = ()) -> None:
        self._command = [*prefix, sys.executable, *self.PROGRAM, "--config", str(config)]
        self._folder = folder
        self._child: Child | None = None

    @property
    def is_running(self) -> bool:
        return self._child is not None and self._child.poll() is None

    @property
    def pid(self) -> int:
        return self._started().pid

    @property
    def log(self) -> Sequence[str]:
        return [] if self._child is None else [line.text for line in self._child.lines()]

    def start(self) -> None:
        if self.is_running:
            raise ParticipantError(f"{self.NAME} runs already")
        self._child = Child(self.NAME, self._command, self._folder, death_signal=self.DEATH_SIGNAL)

    def wait_for(self, code: str, limit_s: float = START_LIMIT_S, **fields: Any) -> LogLine:
        return self._started().wait_for(code, limit_s, **fields)

    def check(self) -> None:
        """Raise ``ParticipantError`` with its last log lines if it has ended unexpectedly."""
        if self._child is not None and (status := self._child.poll()) is not None:
            raise ParticipantError(self._child.exit_report(status))

    def request_stop(self) -> None:
        if self._child is not None:
            self._child.terminate()
            self.thaw()

    def stop(self) -> None:
        if self._child is not None:
            self.request_stop()
            self._child.wait()

    def kill(self) -> None:
        if self._child is not None:
            self._child.signal(signal.SIGKILL)
            self._child.wait()

    def freeze(self) -> None:
        self._started().signal(signal.SIGSTOP)

    def thaw(self) -> None:
        self._started().signal(signal.SIGCONT)

    def _started(self) -> Child:
        if self._child is None:
            raise ParticipantError(f"{self.NAME} was not started")
        return self._child


class RealRaspilot(RealProgram):
    """The daemon, started as on a Raspberry Pi; satisfies ``participants.Raspilot``."""

    NAME, PROGRAM = "raspilot", ("-m", "raspilot")
    # A frozen daemon receives only this signal when we are killed.
    DEATH_SIGNAL = signal.SIGKILL


class RealProxy(RealProgram):
    """``up-proxy --config DIR``."""

    NAME, PROGRAM = "proxy", ("-m", "up_proxy.main")

    def wait_for_ports(self) -> None:
        """Wait for ``airborne_port`` and ``ground_port``; raises as ``Child.wait_for``."""
        self.airborne_port = int(self.wait_for("port_open", side="airborne").fields["port"])
        self.ground_port = int(self.wait_for("port_open", side="ground").fields["port"])


class RealRunner(RealProgram):
    """``up-runner --config DIR``.

    Its instances end with it if ``runner.yml`` has ``stop instances on exit: true``.
    """

    NAME, PROGRAM = "runner", ("-m", "up_runner.main")

    def wait_for_port(self) -> None:
        """Wait for ``port``; raises as ``Child.wait_for``."""
        self.port = int(self.wait_for("port_open").fields["port"])
