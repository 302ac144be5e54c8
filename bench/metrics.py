"""A scrape of the running daemon's metrics, beside prometheus-client's own page of as many."""

import sys
import urllib.request
from collections.abc import Iterable

from bench.daemon import ROOT, daemon
from bench.processes import cpu_s, running, wait_until
from bench.table import LeftOutError, Row, compared
from bench.timing import Limit
from up.system.figures import is_installed
from up_simulator.harness.ports import choose_ports

SCRAPES, QUICK_SCRAPES = 100, 20
ROUNDS, QUICK_ROUNDS = 15, 3
TARGET = Limit(10.0)
"""Half of the time after which a handler counts as blocking."""


def scrape(port: int) -> bytes:
    with urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=20) as answer:
        page: bytes = answer.read()
    return page


def cpu_ms(pid: int, port: int, scrapes: int) -> float:
    """Return the CPU time of one scrape in the program that answers."""
    before_s = cpu_s(pid)
    for _ in range(scrapes):
        scrape(port)
    return (cpu_s(pid) - before_s) / scrapes * 1e3


def answers(port: int) -> bool:
    try:
        return bool(scrape(port))
    except OSError:
        return False


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield the CPU time; the daemon does nothing else for as long."""
    if not is_installed():
        raise LeftOutError("prometheus-client is not installed")
    scrapes, rounds = (QUICK_SCRAPES, QUICK_ROUNDS) if quick else (SCRAPES, ROUNDS)
    peer_port = choose_ports(any_ports=True).metrics
    with daemon(has_metrics=True) as ours:
        port = ours.ports.metrics
        wait_until(lambda: answers(port), "the daemon's metrics")
        count = scrape(port).count(b"\nup_")
        command = (sys.executable, "-m", "bench.metrics_peer", str(peer_port), str(count))
        with running(command, cwd=ROOT) as peer:
            wait_until(lambda: answers(peer_port), "the peer's metrics")
            pairs = [
                (cpu_ms(ours.pid, port, scrapes), cpu_ms(peer.pid, peer_port, scrapes))
                for _ in range(rounds)
            ]
    mine, theirs = zip(*pairs, strict=True)
    what = f"metrics, CPU of a scrape of the daemon, {count} figures"
    yield compared(what, "ms", mine, "prometheus-client alone", theirs)
    yield compared(
        "metrics, time that a scrape takes of the daemon's loop", "ms", mine, limit=TARGET
    )
