"""Sensor to actuator: orientation bytes into a pty, Output bytes out, through the running daemon.

Peers, measured in turns, a few seconds each: a C program that echoes the same bytes (the floor of
the machine), an echo through the daemon's reactor and serial line, the same daemon with Python's
own garbage collector (the control run), and the daemon at nice 0 beside programs that occupy every
core. All but the last run with real-time priority where it is permitted, so that other programs'
load changes the figures little.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from bench.board import Board, Latency, terminal
from bench.daemon import CONTROL, MAIN, ROOT, daemon
from bench.processes import busy_loops, running
from bench.table import Row, compared
from bench.timing import Limit

RATE_HZ = 1000
SECONDS, QUICK_SECONDS = 4.0, 0.5
ROUNDS, QUICK_ROUNDS = 7, 5
MIN_TAIL_FRAMES = 3000
"""With fewer frames in a round the p99.9 is only its slowest frames: noise."""
BUSY_LOOPS = 2
PRIORITY = 20
ANSWER_LIMIT_S = 30.0
P50_TARGET, P99_TARGET = 2.3, 2.5
CONTROL_TARGET, HOGS_TARGET = 10.0, 15.0
FLOOR_SOURCE = Path(__file__).with_name("floor.c")
FLOOR = "C floor (epoll echo)"
WHAT = "sensor to actuator through the daemon, 1 kHz"


@contextmanager
def floor_board(priority: int = 0) -> Iterator[Board | None]:
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None:
        yield None
        return
    with tempfile.TemporaryDirectory() as folder, terminal() as (board_end, port):
        program = Path(folder, "floor")
        subprocess.run([compiler, "-O2", "-o", program, FLOOR_SOURCE], check=True)
        with running((program, port, *([str(priority)] if priority else []))):
            yield Board(board_end)


@contextmanager
def echo_board(priority: int = 0) -> Iterator[Board]:
    with (
        terminal() as (board_end, port),
        running((sys.executable, "-m", "bench.serial_echo", port, str(priority)), cwd=ROOT),
    ):
        yield Board(board_end)


@contextmanager
def daemon_board(
    program: Path = MAIN, priority: int = 0, is_recorded: bool = True
) -> Iterator[Board]:
    with (
        terminal() as (board_end, port),
        daemon(port, priority=priority, program=program, is_recorded=is_recorded),
    ):
        yield Board(board_end)


def in_turns(boards: list[Board], seconds: float, rounds: int) -> list[list[Latency]]:
    """Measure each board's program in each round, and return the rounds of each."""
    found: list[list[Latency]] = [[] for _ in boards]
    for _ in range(rounds):
        for figures, board in zip(found, boards, strict=True):
            # A board that was silent during the others' turns counts as lost.
            board.wait_for_answer(ANSWER_LIMIT_S)
            figures.append(board.measure(RATE_HZ, seconds))
    return found


def tail_rows(seconds: float, rounds: int) -> Iterable[Row]:
    priority = PRIORITY if may_be_realtime() else 0
    with (
        floor_board(priority) as floor,
        echo_board(priority) as echo,
        daemon_board(priority=priority) as mine,
        daemon_board(CONTROL, priority) as other,
    ):
        boards = [mine, other, echo] + ([floor] if floor else [])
        ours, control, echoes, *floors = in_turns(boards, seconds, rounds)
    theirs = floors[0] if floors else []
    yield from floor_rows(ours, theirs)
    what = "the same, an echo by reactor and serial line alone, p50"
    figures = [[each.p50_us for each in runs] for runs in (echoes, theirs)]
    yield compared(what, "us", figures[0], FLOOR, figures[1], missing="no C compiler")
    yield collector_row(ours, control, int(seconds * RATE_HZ))
    lost, sent = sum(each.lost for each in ours), sum(each.sent for each in ours)
    yield Row(f"{WHAT}, Outputs lost", f"{lost} of {sent}", target="0", met=lost == 0)


def floor_rows(ours: list[Latency], floors: list[Latency]) -> Iterable[Row]:
    for name, limit in (("p50", P50_TARGET), ("p99", P99_TARGET)):
        figures, theirs = ([getattr(run, f"{name}_us") for run in runs] for runs in (ours, floors))
        yield compared(
            f"{WHAT}, {name}", "us", figures, FLOOR, theirs, Limit(limit), "no C compiler"
        )


def collector_row(ours: list[Latency], control: list[Latency], frames: int) -> Row:
    what, peer = f"{WHAT}, p99.9", "control run, Python's collector"
    if frames < MIN_TAIL_FRAMES:
        return Row(what, left_out=f"{frames} frames a round, it needs {MIN_TAIL_FRAMES}")
    figures = [[each.p999_us for each in runs] for runs in (ours, control)]
    limit = Limit(CONTROL_TARGET, is_minimum=True)
    return compared(what, "us", figures[0], peer, figures[1], limit)


def busy_row(seconds: float, rounds: int) -> Row:
    """Return the tail under real-time priority beside that at nice 0, with every core occupied."""
    what = f"{WHAT}, {BUSY_LOOPS} CPU busy_loops, SCHED_FIFO {PRIORITY}, p99"
    if not may_be_realtime():
        return Row(what, left_out="real-time priority is not permitted here")
    with ExitStack() as stack:
        boards = [stack.enter_context(daemon_board(priority=each)) for each in (PRIORITY, 0)]
        stack.enter_context(busy_loops(BUSY_LOOPS))
        runs = in_turns(boards, seconds, rounds)
    realtime, nice = ([each.p99_us for each in run] for run in runs)
    limit = Limit(HOGS_TARGET, is_minimum=True)
    return compared(what, "us", realtime, "the same at nice 0", nice, limit)


def may_be_realtime() -> bool:
    before = os.sched_getscheduler(0), os.sched_getparam(0)
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
    except PermissionError:
        return False
    os.sched_setscheduler(0, *before)
    return True


def rows(quick: bool = False) -> Iterable[Row]:
    seconds, rounds = (QUICK_SECONDS, QUICK_ROUNDS) if quick else (SECONDS, ROUNDS)
    yield from tail_rows(seconds, rounds)
    yield busy_row(seconds, rounds)
