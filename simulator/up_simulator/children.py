"""The processes that the showcase starts, with their output kept in a file each."""

from __future__ import annotations

import contextlib
import os
import subprocess
import time
from pathlib import Path

STOP_LIMIT_S = 5.0
_LAST_LINES = 15


class ChildFailedError(Exception):
    """A process ended, or did not get ready; the text is for the user, with its last words."""


class Child:
    """One process in a session of its own, so that Ctrl-C reaches it through us alone."""

    def __init__(
        self, name: str, command: list[str], folder: Path, *, in_foreground: bool = False
    ) -> None:
        self.name = name
        self.folder = folder
        self._log = folder / f"{name}.log"
        output = None if in_foreground else self._log.open("wb")
        environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
        self._process = subprocess.Popen(
            command,
            stdin=None if in_foreground else subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT if output else None,
            env=environment,
            start_new_session=not in_foreground,
        )
        if output is not None:
            output.close()

    @classmethod
    def in_foreground(cls, name: str, command: list[str], folder: Path) -> Child:
        """Start a process that has the terminal."""
        return cls(name, command, folder, in_foreground=True)

    def poll(self) -> int | None:
        """Return the exit status; None while it runs."""
        return self._process.poll()

    def lines(self) -> list[str]:
        """Return what it printed so far."""
        return self._log.read_text(encoding="utf-8", errors="replace").splitlines()

    def wait_for_line(self, text: str, limit_s: float) -> None:
        """Wait until it printed a line with a text; raises ChildFailedError."""
        deadline_s = time.monotonic() + limit_s
        while not any(text in line for line in self.lines()):
            status = self.poll()
            if status is not None:
                raise ChildFailedError(self.last_words(status))
            if time.monotonic() > deadline_s:
                raise ChildFailedError(
                    f"{self.name} did not say {text!r} within {limit_s:.0f} s\n{self._tail()}"
                )
            time.sleep(0.02)

    def last_words(self, status: int) -> str:
        """Return the sentence that says how it ended, and the end of its log."""
        how = f"signal {-status}" if status < 0 else f"status {status}"
        return f"{self.name} ended by itself with {how}; its log {self._log} ends:\n{self._tail()}"

    def terminate(self) -> None:
        """Ask it to end."""
        with contextlib.suppress(ProcessLookupError):
            self._process.terminate()

    def wait(self) -> None:
        """Wait for its end; force it after ``STOP_LIMIT_S``."""
        try:
            self._process.wait(STOP_LIMIT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _tail(self) -> str:
        if not self._log.exists():
            return ""
        return "\n".join(f"  {line}" for line in self.lines()[-_LAST_LINES:])
