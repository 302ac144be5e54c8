"""The share of a core that the daemon takes: in flight at the usual rates, and idle."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from bench.board import Board, terminal
from bench.daemon import Daemon, daemon
from bench.ground import Ground
from bench.processes import cpu_s, stat_cpu_s, wait_until
from bench.startup import wait_for_ports
from bench.table import Row, compared
from bench.timing import Limit

RATE_HZ = 50
SECONDS, QUICK_SECONDS = 5.0, 1.0
ROUNDS, QUICK_ROUNDS = 5, 3
SETTLE_S = 2.0
ANSWER_LIMIT_S = 30.0
FLIGHT_TARGET, IDLE_TARGET = Limit(2.5), Limit(0.1)
UNIT = "% of a core"


class Flown:
    """A daemon with a board at its serial line and a ground that receives its telemetry."""

    def __init__(self, daemon: Daemon, board: Board, ground: Ground) -> None:
        self._daemon, self._board, self._ground = daemon, board, ground
        self.frames_hz = 0.0
        self.bytes_a_second = 0.0

    def cpu_percent(self, seconds: float) -> float:
        """Return the share of a core with receiver, orientation and Outputs at 50 Hz."""
        flying = threading.Thread(
            target=self._board.measure, args=(RATE_HZ, SETTLE_S + seconds + 1.0)
        )
        flying.start()
        time.sleep(SETTLE_S)
        before, frames = recorded_bytes(self._daemon.flights), self._ground.frames
        percent = _cpu_percent(self._daemon.pid, seconds)
        self.frames_hz = (self._ground.frames - frames) / seconds
        self.bytes_a_second = (recorded_bytes(self._daemon.flights) - before) / seconds
        flying.join()
        return percent


@contextmanager
def flight(is_recorded: bool = True) -> Iterator[Flown]:
    with (
        Ground() as ground,
        terminal() as (board_end, port),
        daemon(port, proxy_port=ground.port, is_recorded=is_recorded) as running,
    ):
        board = Board(board_end)
        board.wait_for_answer(ANSWER_LIMIT_S)
        wait_until(lambda: ground.frames, "telemetry on the ground")
        yield Flown(running, board, ground)


def recorded_bytes(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.glob("*.mcap"))


def flight_row(seconds: float, rounds: int) -> Row:
    with flight() as flown:
        shares = [flown.cpu_percent(seconds) for _ in range(rounds)]
    what = f"CPU at {RATE_HZ} Hz RX + {RATE_HZ} Hz orientation + {flown.frames_hz:.0f} Hz telemetry"
    return compared(what, UNIT, shares, limit=FLIGHT_TARGET)


def idle_row(seconds: float, rounds: int) -> Row:
    with daemon() as running:
        wait_for_ports(running.ports)
        time.sleep(SETTLE_S)
        shares = [_cpu_percent(running.pid, seconds) for _ in range(rounds)]
    return compared("CPU idle, no peer", UNIT, shares, limit=IDLE_TARGET)


def _cpu_percent(pid: int, seconds: float) -> float:
    """Return the share of a core over some seconds.

    schedstat and /proc/<pid>/stat must agree to the ticks of the latter.
    """
    began_s, used_s, ticks_s = time.monotonic(), cpu_s(pid), stat_cpu_s(pid)
    time.sleep(seconds)
    used_s, ticks_s = cpu_s(pid) - used_s, stat_cpu_s(pid) - ticks_s
    passed_s = time.monotonic() - began_s
    if ticks_s > used_s + 0.05 + 0.2 * used_s:
        raise RuntimeError(f"CPU time: {used_s:.3f} s by schedstat, {ticks_s:.3f} s by stat")
    return 100 * used_s / passed_s


def rows(quick: bool = False) -> Iterable[Row]:
    seconds, rounds = (QUICK_SECONDS, QUICK_ROUNDS) if quick else (SECONDS, ROUNDS)
    yield flight_row(seconds, rounds)
    yield idle_row(seconds, rounds)
