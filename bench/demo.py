"""`make run`'s processes: the share of a core of each while the virtual aircraft flies."""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Iterable
from pathlib import Path

from bench.processes import cpu_s, running, tree, wait_until
from bench.table import Row, compared
from up_simulator.demo.hints import LAST_HINT

SETTLE_S = 10.0
SECONDS, QUICK_SECONDS = 5.0, 1.0
ROUNDS = 5
UNIT = "% of a core"
OPTIONS = ("--any-ports", "--no-watch")


def rows(quick: bool = False) -> Iterable[Row]:
    seconds = QUICK_SECONDS if quick else SECONDS
    with tempfile.TemporaryDirectory(prefix="upb-") as name:
        folder = Path(name)
        log = folder / "log"
        command = (sys.executable, "-m", "up_simulator.demo", "--folder", folder, *OPTIONS)
        with log.open("w") as stream, running(command, stream, folder) as program:
            wait_until(
                lambda: program.poll() is not None or LAST_HINT in log.read_text(),
                "the flight of make run",
            )
            if program.poll() is not None:
                raise RuntimeError(f"make run ended: {log.read_text().strip()}")
            time.sleep(SETTLE_S)
            titles = {pid: _title(pid) for pid in tree(program.pid)}
            shares: dict[int, list[float]] = {pid: [] for pid in titles}
            for _ in range(ROUNDS):
                began_s, before = time.monotonic(), {pid: cpu_s(pid) for pid in titles}
                time.sleep(seconds)
                passed_s = time.monotonic() - began_s
                for pid, figures in shares.items():
                    figures.append(100 * (cpu_s(pid) - before[pid]) / passed_s)
    for pid, title in titles.items():
        yield compared(f"make run, CPU of {title}", UNIT, shares[pid])
    yield compared(
        "make run, CPU of all", UNIT, [sum(each) for each in zip(*shares.values(), strict=True)]
    )


def _title(pid: int) -> str:
    """Return the program of a process: Python's module or script, otherwise its own name."""
    words = Path(f"/proc/{pid}/cmdline").read_text().split("\0")
    if "-m" in words:
        return words[words.index("-m") + 1]
    return Path(next((word for word in words if word.endswith(".py")), words[0])).name
