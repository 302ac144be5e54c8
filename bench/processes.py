"""Programs under measurement: started, pinned to a core, read from /proc, ended."""

import os
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

TICKS_S = os.sysconf("SC_CLK_TCK")
PAGE = os.sysconf("SC_PAGE_SIZE")
END_S = 5.0
DEADLINE_S = 60.0


def environment() -> dict[str, str]:
    """Return a user's environment, without settings that change how Python starts or Up runs."""
    return {
        name: text for name, text in os.environ.items() if not name.startswith(("PYTHON", "UP_"))
    }


@contextmanager
def running(
    command: Sequence[str | Path], log: IO[str] | int = subprocess.DEVNULL, cwd: Path | None = None
) -> Iterator[subprocess.Popen[bytes]]:
    process = subprocess.Popen(
        [str(word) for word in command],
        stdin=subprocess.DEVNULL,
        stdout=log,
        stderr=log,
        cwd=cwd,
        env=environment(),
    )
    try:
        yield process
    finally:
        process.terminate()
        try:
            process.wait(END_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


@contextmanager
def busy_loops(count: int) -> Iterator[None]:
    spinning = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(count)]
    try:
        yield
    finally:
        for each in spinning:
            each.kill()
        for each in spinning:
            each.wait()


def wait_until(condition: Callable[[], object], what: str, deadline_s: float = DEADLINE_S) -> None:
    """Return when the condition holds; raises RuntimeError after the deadline."""
    end_s = time.monotonic() + deadline_s
    while not condition():
        if time.monotonic() > end_s:
            raise RuntimeError(f"not within {deadline_s:.0f} s: {what}")
        time.sleep(0.01)


def tree(pid: int) -> list[int]:
    found = [pid]
    for task in Path(f"/proc/{pid}/task").iterdir():
        for child in (task / "children").read_text().split():
            found += tree(int(child))
    return found


def cpu_s(pid: int) -> float:
    """Return the CPU time of a process, all its threads, user and system, in seconds.

    From schedstat in nanoseconds: /proc/<pid>/stat counts ticks of 10 ms, too coarse for a program
    that sleeps nearly always.
    """
    total_ns = 0
    for task in Path(f"/proc/{pid}/task").iterdir():
        # A thread may end during the loop.
        with suppress(FileNotFoundError, ProcessLookupError):
            total_ns += int((task / "schedstat").read_text().split()[0])
    return total_ns / 1e9


def stat_cpu_s(pid: int) -> float:
    """Return the CPU time that /proc/<pid>/stat counts, in seconds."""
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS_S


def resident_mib(pid: int) -> float:
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE / 2**20
