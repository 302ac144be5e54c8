"""The share of a core that the daemon takes: in flight at the usual rates, and idle."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterable
from pathlib import Path

from bench.board import Board, terminal
from bench.daemon import daemon
from bench.ground import Ground
from bench.processes import cpu_s, stat_cpu_s, wait_until
from bench.startup import wait_for_ports
from bench.table import Row

RATE_HZ = 50
SECONDS, QUICK_SECONDS = 15.0, 2.0
SETTLE_S = 2.0
GREET_S = 30.0
FLIGHT_TARGET, IDLE_TARGET = 0.025, 0.001
PROTOTYPE, MAVPROXY = "thesis: prototype on a Pi B+, 20 + 20 Hz", "MAVProxy idle (seen once)"


def flight_share(seconds: float, is_recorded: bool = True) -> tuple[float, float, float]:
    """Return the share of a core with receiver, orientation and Outputs at 50 Hz.

    And how many frames of telemetry came in a second, how many bytes were recorded in one.
    """
    with (
        Ground() as ground,
        terminal() as (board_end, port),
        daemon(port, proxy_port=ground.port, is_recorded=is_recorded) as running,
    ):
        board = Board(board_end)
        board.greet(GREET_S)
        wait_until(lambda: ground.frames, "telemetry on the ground")
        flying = threading.Thread(target=board.measure, args=(RATE_HZ, SETTLE_S + seconds + 1.0))
        flying.start()
        time.sleep(SETTLE_S)
        before = recorded_bytes(running.flights)
        share, frames = _share(running.pid, seconds, ground)
        written = recorded_bytes(running.flights) - before
        flying.join()
    return share, frames / seconds, written / seconds


def recorded_bytes(folder: Path) -> int:
    """Return the size of all flights in a folder."""
    return sum(path.stat().st_size for path in folder.glob("*.mcap"))


def flight_row(seconds: float) -> Row:
    """Return the share in flight, recorded as it is shipped."""
    share, frames_hz, _ = flight_share(seconds)
    return Row(
        f"CPU at {RATE_HZ} Hz RX + {RATE_HZ} Hz orientation + {frames_hz:.0f} Hz telemetry",
        f"{share:.2%}",
        PROTOTYPE,
        "40%",
        f"{0.40 / share:.0f}x less" if share else "",
        f"<= {FLIGHT_TARGET:.1%} of a core",
        share <= FLIGHT_TARGET,
    )


def idle_row(seconds: float) -> Row:
    """Return the share without any peer."""
    with daemon() as running:
        wait_for_ports(running.ports)
        time.sleep(SETTLE_S)
        share, _ = _share(running.pid, seconds)
    return Row(
        "CPU idle, no peer",
        f"{share:.3%}",
        MAVPROXY,
        "3%",
        f"{0.03 / share:.0f}x less" if share else "",
        f"<= {IDLE_TARGET:.1%} of a core",
        share <= IDLE_TARGET,
    )


def _share(pid: int, seconds: float, ground: Ground | None = None) -> tuple[float, int]:
    """Return the share of a core over some seconds, and how much telemetry came meanwhile.

    schedstat and /proc/<pid>/stat must agree to the ticks of the latter.
    """
    frames = ground.frames if ground else 0
    began_s, used_s, ticks_s = time.monotonic(), cpu_s(pid), stat_cpu_s(pid)
    time.sleep(seconds)
    used_s, ticks_s = cpu_s(pid) - used_s, stat_cpu_s(pid) - ticks_s
    passed_s = time.monotonic() - began_s
    if ticks_s > used_s + 0.05 + 0.2 * used_s:
        raise RuntimeError(f"CPU time: {used_s:.3f} s by schedstat, {ticks_s:.3f} s by stat")
    return used_s / passed_s, (ground.frames if ground else 0) - frames


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield both shares."""
    seconds = QUICK_SECONDS if quick else SECONDS
    yield flight_row(seconds)
    yield idle_row(seconds)
