"""The cost of recording the flight: CPU, latency of control, bytes; with and without, in turns."""

from __future__ import annotations

from collections.abc import Iterable

from bench import latency, load
from bench.table import Row, compared
from bench.timing import Limit

PEER = "not recorded"
HOUR_S = 3600.0
CPU_TARGET, MB_TARGET = Limit(1.2), Limit(100.0)


def load_rows(seconds: float, rounds: int) -> Iterable[Row]:
    shares: list[list[float]] = [[], []]
    written = []
    with load.flight() as recorded, load.flight(is_recorded=False) as other:
        for _ in range(rounds):
            for figures, flown in zip(shares, (recorded, other), strict=True):
                figures.append(flown.cpu_percent(seconds))
            written.append(recorded.bytes_a_second * HOUR_S / 1e6)
    ours, theirs = shares
    yield compared("CPU in flight, recorded", load.UNIT, ours, PEER, theirs, CPU_TARGET)
    yield compared("recorded in an hour of flight", "MB", written, limit=MB_TARGET)


def latency_rows(seconds: float, rounds: int) -> Iterable[Row]:
    with latency.daemon_board() as recorded, latency.daemon_board(is_recorded=False) as other:
        runs = latency.in_turns([recorded, other], seconds, rounds)
    for name in ("p50", "p99", "p999"):
        ours, theirs = ([getattr(each, f"{name}_us") for each in run] for run in runs)
        title = name.replace("999", "99.9")
        yield compared(f"sensor to actuator, recorded, {title}", "us", ours, PEER, theirs)


def rows(quick: bool = False) -> Iterable[Row]:
    rounds = load.QUICK_ROUNDS if quick else load.ROUNDS
    yield from load_rows(load.QUICK_SECONDS if quick else load.SECONDS, rounds)
    yield from latency_rows(latency.QUICK_SECONDS if quick else latency.SECONDS, rounds)
