"""Ends a process at the deadline of its lease, whatever its runner and its event loop do.

A runner of a pool (docs/pool.md) writes the deadline into a file at each renewal of the lease. The
clock is CLOCK_BOOTTIME: it counts the time in which the machine is suspended.
"""

import math
import os
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path

VARIABLE = "UP_DEADLINE_FILE"
PERIOD_S = 0.1
EXIT_STATUS = 75
"""EX_TEMPFAIL of sysexits.h: the same program may run elsewhere."""


def now_s() -> float:
    """Return the time that deadlines count by, in seconds since boot."""
    return time.clock_gettime(time.CLOCK_BOOTTIME)


def write_deadline(path: Path, deadline_s: float) -> None:
    """Write a deadline atomically; raises OSError."""
    temporary = path.with_name(f".{path.name}.tmp")
    temporary.write_text(f"{deadline_s:.3f}\n", encoding="ascii")
    temporary.replace(path)


def read_deadline(path: Path) -> float:
    """Return the deadline in a file; minus infinity without one."""
    try:
        return float(path.read_text(encoding="ascii"))
    except (OSError, ValueError):
        return -math.inf


class DeadlineWatch:
    """A thread that reads the file every PERIOD_S and calls `end` when the deadline has passed.

    A deadline is never withdrawn: one that cannot be read, or is earlier, changes nothing.
    """

    def __init__(self, path: Path, end: Callable[[], object]) -> None:
        self._path = path
        self._end = end
        self._deadline_s = now_s()

    def start(self) -> None:
        threading.Thread(target=self._run, name="deadline-watch", daemon=True).start()

    def _run(self) -> None:
        while not self.is_over():
            time.sleep(PERIOD_S)
        self._end()

    def is_over(self) -> bool:
        self._deadline_s = max(self._deadline_s, read_deadline(self._path))
        return not now_s() < self._deadline_s


def start_from_environment(environ: Mapping[str, str]) -> None:
    """Watch the deadline that a runner set, if there is one.

    The process ends without a word: a log on a disk that hangs would delay it.
    """
    path = environ.get(VARIABLE)
    if path:
        DeadlineWatch(Path(path), lambda: os._exit(EXIT_STATUS)).start()
