"""Sensor to actuator: orientation bytes into a pty, Output bytes out, through the running daemon.

Peers, all in one run and in turns: a C program that echoes the same bytes (the floor of the
machine), the same daemon with Python's own garbage collector (the control run), and the daemon at
nice 0 beside programs that take every core.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from bench.board import Board, Latency, terminal
from bench.daemon import CONTROL, MAIN, daemon
from bench.processes import hogs, running
from bench.table import Row

RATE_HZ = 1000
SECONDS, QUICK_SECONDS = 10.0, 1.0
ROUNDS = 3
HOGS = 2
PRIORITY = 20
GREET_S = 30.0
P50_TARGET, P99_TARGET = 1.6, 2.5
CONTROL_TARGET, HOGS_TARGET = 10.0, 15.0
FLOOR_SOURCE = Path(__file__).with_name("floor.c")
WHAT = "sensor to actuator through the daemon, 1 kHz"


@contextmanager
def floor_program() -> Iterator[Path | None]:
    """Yield the compiled floor; None without a C compiler."""
    with tempfile.TemporaryDirectory() as folder:
        compiler = shutil.which("gcc") or shutil.which("cc")
        if compiler is None:
            yield None
            return
        program = Path(folder, "floor")
        subprocess.run([compiler, "-O2", "-o", program, FLOOR_SOURCE], check=True)
        yield program


def measure_floor(program: Path, seconds: float) -> Latency:
    """Measure the C echo."""
    with terminal() as (board_end, port), running((program, port)):
        board = Board(board_end)
        board.greet(GREET_S)
        return board.measure(RATE_HZ, seconds)


def measure_daemon(seconds: float, program: Path = MAIN, priority: int = 0) -> Latency:
    """Measure the daemon."""
    with terminal() as (board_end, port), daemon(port, priority=priority, program=program):
        board = Board(board_end)
        board.greet(GREET_S)
        return board.measure(RATE_HZ, seconds)


def quietest(runs: list[Latency]) -> Latency:
    """Return the least of each figure over several rounds, and all frames and losses."""
    return Latency(
        sum(run.sent for run in runs),
        sum(run.lost for run in runs),
        min(run.p50_us for run in runs),
        min(run.p99_us for run in runs),
        min(run.p999_us for run in runs),
    )


def tail_rows(quick: bool) -> Iterable[Row]:
    """Yield the rows against the floor and against the control run."""
    seconds, rounds = (QUICK_SECONDS, 1) if quick else (SECONDS, ROUNDS)
    floors, ours, controls = [], [], []
    with floor_program() as program:
        for _ in range(rounds):
            if program is not None:
                floors.append(measure_floor(program, seconds))
            ours.append(measure_daemon(seconds))
            controls.append(measure_daemon(seconds, CONTROL))
    mine = quietest(ours)
    yield from floor_rows(mine, quietest(floors) if floors else None)
    control = quietest(controls)
    gain = control.p999_us / mine.p999_us
    yield Row(
        f"{WHAT}, p99.9",
        f"{mine.p999_us:.0f} us",
        "control run, Python's collector",
        f"{control.p999_us:.0f} us",
        f"{gain:.1f}x better",
        f">= {CONTROL_TARGET:g}x better",
        gain >= CONTROL_TARGET,
    )
    yield Row(
        f"{WHAT}, Outputs lost",
        f"{mine.lost} of {mine.sent}",
        target="0",
        met=mine.lost == 0,
    )


def floor_rows(mine: Latency, floor: Latency | None) -> Iterable[Row]:
    """Yield the middle and the tail beside the floor."""
    peer = "C floor (epoll echo)"
    for name, figure, theirs, target in (
        ("p50", mine.p50_us, floor.p50_us if floor else None, P50_TARGET),
        ("p99", mine.p99_us, floor.p99_us if floor else None, P99_TARGET),
    ):
        what, ours = f"{WHAT}, {name}", f"{figure:.0f} us"
        if theirs is None:
            yield Row(what, ours, peer, "no C compiler", "", f"<= {target}x")
            continue
        ratio = figure / theirs
        yield Row(
            what, ours, peer, f"{theirs:.0f} us", f"{ratio:.2f}x", f"<= {target}x", ratio <= target
        )


def hogs_row(quick: bool) -> Row:
    """Return the tail under real-time priority beside that at nice 0, with every core taken."""
    seconds = QUICK_SECONDS if quick else SECONDS
    what = f"{WHAT}, {HOGS} CPU hogs, SCHED_FIFO {PRIORITY}, p99"
    target = f">= {HOGS_TARGET:g}x better"
    if not may_be_realtime():
        return Row(what, "not permitted here", "the same at nice 0", target=target)
    with hogs(HOGS):
        nice = measure_daemon(seconds)
        realtime = measure_daemon(seconds, priority=PRIORITY)
    gain = nice.p99_us / realtime.p99_us
    return Row(
        what,
        f"{realtime.p99_us:.0f} us",
        "the same at nice 0",
        f"{nice.p99_us:.0f} us",
        f"{gain:.1f}x better",
        target,
        gain >= HOGS_TARGET,
    )


def may_be_realtime() -> bool:
    """Return whether this user may take SCHED_FIFO."""
    before = os.sched_getscheduler(0), os.sched_getparam(0)
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
    except PermissionError:
        return False
    os.sched_setscheduler(0, *before)
    return True


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield the latency rows."""
    yield from tail_rows(quick)
    yield hogs_row(quick)
