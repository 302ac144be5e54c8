"""A child process with its output in a file, ended in every case."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import IO

from up.system.pid_file import VARIABLE
from up_simulator.harness.participants import CrewError

STOP_LIMIT_S = 5.0
LAST_LINES = 15
TAIL_BYTES = 65_536
LOOK_AGAIN_S = 0.02
_PR_SET_PDEATHSIG = 1


class Child:
    """One process in its own session, so that Ctrl-C reaches it through us alone.

    Its output is appended to ``<name>.log`` in ``folder``; ``<name>.pid`` there has its process
    number if the program writes one. On Linux it gets a signal, by ``wish``, when we die without
    ending it. ``in_foreground`` leaves it the terminal; its output is not kept. With ``talks`` its
    standard input and output are ``input`` and ``output``, and only its error output is kept.
    """

    def __init__(
        self,
        name: str,
        command: list[str],
        folder: Path,
        *,
        in_foreground: bool = False,
        talks: bool = False,
        wish: int = signal.SIGTERM,
    ) -> None:
        self.name = name
        self.log = folder / f"{name}.log"
        self._pid_file = folder / f"{name}.pid"
        self._start_at = 0
        output = None
        if not in_foreground:
            output = self.log.open("ab")
            self._start_at = output.tell()
        self._told_at = self._start_at
        try:
            self._process = subprocess.Popen(
                command,
                stdin=_input_of(in_foreground, talks),
                stdout=subprocess.PIPE if talks else output,
                stderr=output if talks else subprocess.STDOUT if output else None,
                env={**os.environ, "PYTHONUNBUFFERED": "1", VARIABLE: str(self._pid_file)},
                start_new_session=not in_foreground,
                preexec_fn=dying_wish(wish),
            )
        finally:
            if output is not None:
                output.close()

    @property
    def input(self) -> IO[bytes]:
        """Return where one that talks is spoken to."""
        assert self._process.stdin is not None
        return self._process.stdin

    @property
    def output(self) -> IO[bytes]:
        """Return the output of one that talks."""
        assert self._process.stdout is not None
        return self._process.stdout

    @property
    def pid(self) -> int:
        """Return its process number."""
        return self._process.pid

    def poll(self) -> int | None:
        """Return the exit status; None while it runs."""
        return self._process.poll()

    def lines(self) -> list[str]:
        """Return the newest lines that this process, not one before it, has printed."""
        if not self.log.exists():
            return []
        with self.log.open("rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(max(self._start_at, size - TAIL_BYTES))
            return file.read().decode("utf-8", "replace").splitlines()

    def new_lines(self) -> list[str]:
        """Return the whole lines that were printed since the last call."""
        if not self.log.exists():
            return []
        with self.log.open("rb") as file:
            file.seek(self._told_at)
            data = file.read(TAIL_BYTES)
        whole = data.rfind(b"\n") + 1
        self._told_at += whole
        return data[:whole].decode("utf-8", "replace").splitlines()

    def wait_for(self, is_ready: Callable[[list[str]], bool], what: str, limit_s: float) -> None:
        """Wait until its lines show that it is ready; raises ``CrewError``."""
        deadline_s = time.monotonic() + limit_s
        while not is_ready(self.lines()):
            status = self.poll()
            if status is not None:
                # The line may be in its last output.
                if is_ready(self.lines()):
                    return
                raise CrewError(self.last_words(status))
            if time.monotonic() > deadline_s:
                raise CrewError(f"{self.name}: no {what} within {limit_s:.0f} s\n{self.tail()}")
            time.sleep(LOOK_AGAIN_S)

    def wait_for_line(self, text: str, limit_s: float) -> str:
        """Wait until it printed a line with a text, and return that; raises ``CrewError``."""
        self.wait_for(lambda lines: any(text in line for line in lines), repr(text), limit_s)
        return next(line for line in self.lines() if text in line)

    def last_words(self, status: int) -> str:
        """Return the sentence about its end, and the end of its log if there is any."""
        how = f"signal {-status}" if status < 0 else f"status {status}"
        ended = f"{self.name} ended by itself with {how}"
        tail = self.tail()
        return f"{ended}; its log {self.log} ends:\n{tail}" if tail else f"{ended} and said nothing"

    def tail(self) -> str:
        """Return its last lines, indented."""
        return "\n".join(f"  {line}" for line in self.lines()[-LAST_LINES:])

    def signal(self, number: int) -> None:
        """Send a signal, unless it has ended."""
        if self._process.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                self._process.send_signal(number)

    def terminate(self) -> None:
        """Send it the signal to end."""
        self.signal(signal.SIGTERM)

    def wait(self, limit_s: float = STOP_LIMIT_S) -> int:
        """Wait for its end, force it after a time, and return its status."""
        try:
            return self._process.wait(limit_s)
        except subprocess.TimeoutExpired:
            self._process.kill()
            return self._process.wait()
        finally:
            # A killed process leaves it behind.
            self._pid_file.unlink(missing_ok=True)

    def end(self) -> int:
        """Send it the signal to end and wait for it; returns its status."""
        self.terminate()
        return self.wait()


def _input_of(in_foreground: bool, talks: bool) -> int | None:
    if talks:
        return subprocess.PIPE
    return None if in_foreground else subprocess.DEVNULL


def dying_wish(
    number: int = signal.SIGTERM, parent: int | None = None
) -> Callable[[], None] | None:
    """Return a function for the child before exec: it requests a signal at our death.

    The child calls it, and gets the signal; ``parent`` is the process that creates it, by default
    this one. None: only Linux supports it.
    """
    if not sys.platform.startswith("linux"):
        return None
    ask = ctypes.CDLL(None).prctl
    awaited = os.getpid() if parent is None else parent

    def wish() -> None:
        ask(_PR_SET_PDEATHSIG, number, 0, 0, 0)
        # A parent that died before this request sends no signal.
        if os.getppid() != awaited:
            os.kill(os.getpid(), number)

    return wish
