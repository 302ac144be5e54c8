"""From the command line to bound ports, and the memory of an idle daemon.

The peer only imports Twisted's reactor, in the same run, in turns.
"""

from __future__ import annotations

import socket
import subprocess
import sys
import time
from collections.abc import Iterable
from contextlib import suppress
from importlib.util import find_spec

from bench.daemon import daemon
from bench.processes import environment, resident_mib, running, wait_until
from bench.table import Row, compared
from bench.timing import Limit
from up_simulator.harness.ports import Ports

IMPORT = "import twisted.internet.reactor"
RATIO_TARGET = 1.6
MEMORY_TARGET_MIB = 38.0
ROUNDS, QUICK_ROUNDS = 12, 3
POLL_S = 0.0005
LIMIT_S = 60.0
SETTLE_S = 5.0
# The memory of a program that only imports the reactor.
HOLD = f"{IMPORT}, time; time.sleep(600)"


def wait_for_ports(ports: Ports, limit_s: float = LIMIT_S) -> None:
    """Return when both TCP ports accept connections; raises RuntimeError after the limit."""
    end_s = time.monotonic() + limit_s
    for port in (ports.general, ports.orientation):
        while not _is_open(port):
            if time.monotonic() > end_s:
                raise RuntimeError(f"the daemon did not bind port {port}")
            time.sleep(POLL_S)


def _is_open(port: int) -> bool:
    with socket.socket() as probe, suppress(ConnectionRefusedError):
        probe.connect(("127.0.0.1", port))
        return True
    return False


def start_s() -> float:
    began_s = time.perf_counter()
    with daemon() as running_daemon:
        wait_for_ports(running_daemon.ports)
        return time.perf_counter() - began_s


def import_s() -> float:
    began_s = time.perf_counter()
    subprocess.run([sys.executable, "-c", IMPORT], check=True, env=environment())
    return time.perf_counter() - began_s


def start_row(rounds: int) -> Row:
    starts, imports = [], []
    start_s()  # the first one writes Python's bytecode
    for _ in range(rounds):
        imports.append(1000 * import_s())
        starts.append(1000 * start_s())
    peer = f"python -c '{IMPORT}'"
    return compared("daemon start to ports bound", "ms", starts, peer, imports, Limit(RATIO_TARGET))


def memory_row(settle_s: float) -> Row:
    with daemon() as idle, running((sys.executable, "-c", HOLD)) as holding:
        wait_for_ports(idle.ports)
        time.sleep(settle_s)
        wait_until(lambda: resident_mib(holding.pid) > 20, "the reactor's import")
        mine, theirs = resident_mib(idle.pid), resident_mib(holding.pid)
    has_openssl = find_spec("OpenSSL") is not None
    return Row(
        f"resident memory idle, {'with' if has_openssl else 'without'} pyOpenSSL",
        f"{mine:.1f} MiB",
        "the reactor's import",
        f"{theirs:.1f} MiB",
        f"{mine / theirs:.2f}x",
        "" if has_openssl else f"<= {MEMORY_TARGET_MIB:.0f} MiB",
        None if has_openssl else mine <= MEMORY_TARGET_MIB,
    )


def rows(quick: bool = False) -> Iterable[Row]:
    yield start_row(QUICK_ROUNDS if quick else ROUNDS)
    yield memory_row(1.0 if quick else SETTLE_S)
