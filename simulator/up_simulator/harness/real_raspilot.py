"""The daemon, started as on a Raspberry Pi: ``python main.py --config DIR``."""

from __future__ import annotations

import signal
import sys
from collections.abc import Sequence
from pathlib import Path

from up_simulator.harness.child import Child
from up_simulator.harness.participants import CrewError

ROOT = Path(__file__).resolve().parents[3]
START_LIMIT_S = 30.0


class RealRaspilot:
    """Satisfies ``protocols.Raspilot`` by a process.

    ``config`` is its configuration folder, ``folder`` gets ``raspilot.log``, one log for all its
    runs. In flight only ``wait_for_line`` and ``stop`` wait for it.
    """

    def __init__(self, config: Path, folder: Path, root: Path = ROOT) -> None:
        self._command = [sys.executable, str(root / "main.py"), "--config", str(config)]
        self._folder = folder
        self._child: Child | None = None

    @property
    def is_running(self) -> bool:
        """Return whether it runs now."""
        return self._child is not None and self._child.poll() is None

    @property
    def pid(self) -> int:
        """Return its process number; raises ``CrewError`` when it was never started."""
        return self._alive().pid

    @property
    def log(self) -> Sequence[str]:
        """Return the newest lines of its newest life."""
        return [] if self._child is None else self._child.lines()

    def start(self) -> None:
        """Make its process; raises ``CrewError`` when it runs already."""
        if self.is_running:
            raise CrewError("raspilot runs already")
        # A frozen daemon receives only this signal when we are killed.
        self._child = Child("raspilot", self._command, self._folder, wish=signal.SIGKILL)

    def wait_for_line(self, text: str, limit_s: float = START_LIMIT_S) -> str:
        """Wait until it has logged a line with a text and return that; raises ``CrewError``."""
        return self._alive().wait_for_line(text, limit_s)

    def check(self) -> None:
        """Raise ``CrewError`` with its last log lines if it has ended unexpectedly."""
        if self._child is not None and (status := self._child.poll()) is not None:
            raise CrewError(self._child.last_words(status))

    def ask_to_stop(self) -> None:
        """Send it the signal to end, as systemd does."""
        if self._child is not None:
            self._child.terminate()
            self.thaw()

    def stop(self) -> None:
        """Send it the signal to end and wait for it."""
        if self._child is not None:
            self.ask_to_stop()
            self._child.wait()

    def kill(self) -> None:
        """Kill it immediately in any state, by ``kill -9``."""
        if self._child is not None:
            self._child.signal(signal.SIGKILL)
            self._child.wait()

    def freeze(self) -> None:
        """Suspend it: it holds its ports and does nothing, as a hung one."""
        self._alive().signal(signal.SIGSTOP)

    def thaw(self) -> None:
        """Resume a frozen one."""
        self._alive().signal(signal.SIGCONT)

    def _alive(self) -> Child:
        if self._child is None:
            raise CrewError("raspilot was not started")
        return self._child
