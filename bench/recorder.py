"""What recording the flight costs: CPU, latency of control, bytes; with and without, in turns."""

from __future__ import annotations

from collections.abc import Iterable

from bench.board import Board, terminal
from bench.daemon import daemon
from bench.latency import GREET_S, RATE_HZ, Latency, quietest
from bench.load import flight_share
from bench.table import Row

CPU_SECONDS, LATENCY_SECONDS, QUICK_SECONDS = 15.0, 10.0, 2.0
ROUNDS = 3
PEER = "not recorded"
HOUR_S = 3600.0


def load_rows(seconds: float, rounds: int) -> Iterable[Row]:
    """Yield the share of a core in flight, the least of several rounds, and what is written."""
    with_it, without, sizes = [], [], []
    for _ in range(rounds):
        share, _, bytes_a_second = flight_share(seconds)
        with_it.append(share)
        sizes.append(bytes_a_second)
        without.append(flight_share(seconds, is_recorded=False)[0])
    mine, theirs = min(with_it), min(without)
    yield Row(
        "CPU in flight, recorded", f"{mine:.2%}", PEER, f"{theirs:.2%}", f"{mine / theirs:.2f}x"
    )
    yield Row("recorded in an hour of flight", f"{max(sizes) * HOUR_S / 1e6:.0f} MB")


def latency_rows(seconds: float, rounds: int) -> Iterable[Row]:
    """Yield the middle and the tail of sensor to actuator at 1 kHz."""
    with_it, without = [], []
    for _ in range(rounds):
        with_it.append(_measure(seconds, True))
        without.append(_measure(seconds, False))
    mine, theirs = quietest(with_it), quietest(without)
    for name, figure, peers in (
        ("p50", mine.p50_us, theirs.p50_us),
        ("p99", mine.p99_us, theirs.p99_us),
        ("p99.9", mine.p999_us, theirs.p999_us),
    ):
        yield Row(
            f"sensor to actuator, recorded, {name}",
            f"{figure:.0f} us",
            PEER,
            f"{peers:.0f} us",
            f"{figure / peers:.2f}x",
        )


def _measure(seconds: float, is_recorded: bool) -> Latency:
    with terminal() as (board_end, port), daemon(port, is_recorded=is_recorded):
        board = Board(board_end)
        board.greet(GREET_S)
        return board.measure(RATE_HZ, seconds)


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield CPU, bytes and latency."""
    rounds = 1 if quick else ROUNDS
    yield from load_rows(QUICK_SECONDS if quick else CPU_SECONDS, rounds)
    yield from latency_rows(QUICK_SECONDS if quick else LATENCY_SECONDS, rounds)
