"""A child process with its log in a file, ended in every case."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from up.system.death_signal import request_death_signal
from up.system.pid_file import VARIABLE
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.user_log import JSON_ENVIRONMENT, LogLine, read_line

STOP_LIMIT_S = 5.0
TAIL_LINES = 15
TAIL_BYTES = 65_536
POLL_PERIOD_S = 0.02


class Child:
    """One process in its own session, so that Ctrl-C reaches it through us alone.

    Its log is appended to ``<name>.log`` in ``folder``, as JSON lines if it is a program of the
    project; ``<name>.pid`` there has its process number if the program writes one. On Linux it
    gets ``death_signal`` when we die without ending it. ``in_foreground`` leaves it the terminal;
    its output is not kept. It runs in ``work_folder``, if there is one.
    """

    def __init__(
        self,
        name: str,
        command: list[str],
        folder: Path,
        *,
        in_foreground: bool = False,
        death_signal: int = signal.SIGTERM,
        environment: Mapping[str, str] | None = None,
        work_folder: Path | None = None,
    ) -> None:
        self.name = name
        self.log = folder / f"{name}.log"
        self._pid_file = folder / f"{name}.pid"
        self._start_at = 0
        variables = {**os.environ, "PYTHONUNBUFFERED": "1", VARIABLE: str(self._pid_file)}
        variables |= environment or {}
        output = None
        if not in_foreground:
            variables |= JSON_ENVIRONMENT
            output = self.log.open("ab")
            self._start_at = output.tell()
        self._read_at = self._start_at
        try:
            self._process = subprocess.Popen(
                command,
                stdin=None if in_foreground else subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT if output else None,
                env=variables,
                cwd=work_folder,
                start_new_session=not in_foreground,
                preexec_fn=request_death_signal(death_signal),
            )
        finally:
            if output is not None:
                output.close()

    @property
    def pid(self) -> int:
        return self._process.pid

    def poll(self) -> int | None:
        return self._process.poll()

    def lines(self) -> list[LogLine]:
        """Return the newest lines of this process, without those of one before it."""
        if not self.log.exists():
            return []
        with self.log.open("rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(max(self._start_at, size - TAIL_BYTES))
            return [read_line(each) for each in file.read().decode("utf-8", "replace").splitlines()]

    def new_lines(self) -> list[LogLine]:
        """Return the complete lines that were logged since the last call."""
        if not self.log.exists():
            return []
        with self.log.open("rb") as file:
            file.seek(self._read_at)
            data = file.read(TAIL_BYTES)
        whole = data.rfind(b"\n") + 1
        self._read_at += whole
        return [read_line(each) for each in data[:whole].decode("utf-8", "replace").splitlines()]

    def wait_for(
        self,
        code: str,
        limit_s: float,
        on_line: Callable[[LogLine], None] | None = None,
        **fields: Any,
    ) -> LogLine:
        """Wait for a line with this code and these fields, and return it.

        ``on_line`` gets the new lines until then. Raises ``ParticipantError`` if the process ends
        before, or at the limit.
        """
        deadline_s = time.monotonic() + limit_s
        while True:
            status = self.poll()
            found = next((line for line in self.lines() if line.has(code, **fields)), None)
            # After the search, so that the line itself is passed on.
            if on_line is not None:
                for line in self.new_lines():
                    on_line(line)
            if found is not None:
                return found
            if status is not None:
                raise ParticipantError(self.exit_report(status))
            if time.monotonic() > deadline_s:
                what = " ".join([code, *(f"{name}={value}" for name, value in fields.items())])
                raise ParticipantError(f"{self.name}: no {what} in {limit_s:g} s\n{self.tail()}")
            time.sleep(POLL_PERIOD_S)

    def exit_report(self, status: int) -> str:
        how = f"signal {-status}" if status < 0 else f"status {status}"
        ended = f"{self.name} ended unexpectedly with {how}"
        tail = self.tail()
        return f"{ended}; the end of its log {self.log}:\n{tail}" if tail else f"{ended}, no log"

    def tail(self) -> str:
        lines = [f"{each.text}\n{each.traceback}".rstrip() for each in self.lines()]
        tail = "\n".join(lines).splitlines()[-TAIL_LINES:]
        return "\n".join(f"  {line}" for line in tail)

    def signal(self, number: int) -> None:
        if self._process.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                self._process.send_signal(number)

    def terminate(self) -> None:
        self.signal(signal.SIGTERM)

    def wait(self) -> int:
        """Wait for its end, force it after a time, and return its status."""
        try:
            return self._process.wait(STOP_LIMIT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            return self._process.wait()
        finally:
            # A killed process leaves it behind.
            self._pid_file.unlink(missing_ok=True)

    def end(self) -> int:
        self.terminate()
        return self.wait()
