"""The proxy beside HAProxy and socat: added round trip, CPU, memory.

Relay and load generator are separate processes, on a core each if there are two; every figure is
from one run on one machine.
"""

import json
import math
import os
import re
import resource
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from bench.processes import cpu_s, resident_mib, running, tree, wait_until
from bench.relay_load import dial
from bench.table import LeftOutError, Row, compared, limited
from bench.timing import Limit
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.programs import RealProxy

PAIRS = 100
RATE_HZ = 50
SIZE = 200
SECONDS = 3.0
ROUNDS, QUICK_ROUNDS = 5, 3
TARGET = Limit(1.2)
PAIR_BYTES_TARGET = 2048
MANY_PAIRS = 5000
MANY_PAIRS_TARGET = Limit(15.0)
STALL_MB_TARGET = 5.0


@dataclass(frozen=True, slots=True)
class Figures:
    """Round trips in microseconds, CPU of the relay in microseconds per round trip."""

    p50_us: float
    p99_us: float
    cpu_us: float
    longest_us: float = math.nan


def tree_cpu_s(pid: int) -> float:
    return sum(map(cpu_s, tree(pid)))


def cores() -> tuple[int, int]:
    """Return the cores of relay and load generator."""
    allowed = sorted(os.sched_getaffinity(0))
    return allowed[0], allowed[-1]


def pinned(*command: str) -> AbstractContextManager[subprocess.Popen[bytes]]:
    """Run a relay on its core; its complaints go to stderr."""
    return running(("taskset", "-c", str(cores()[0]), *command), sys.stderr)


@contextmanager
def our_proxy(more: str = "") -> Iterator[tuple[int, int, int]]:
    """Run up-proxy on the relay's core; yield its pid, its airborne and its ground port."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "proxy.yml").write_text(
            "airborne port: 0\nground port: 0\nmetrics: false\n"
            "limits:\n  connections per side: 6000\n  connections per address: 6000\n"
            f"  aircraft: 6000\n  connections per second: 100000\n{more}"
        )
        proxy = RealProxy(folder, folder)
        proxy.start()
        try:
            proxy.wait_for_ports()
            os.sched_setaffinity(proxy.pid, {cores()[0]})
            yield proxy.pid, proxy.airborne_port, proxy.ground_port
        except ParticipantError as error:
            raise RuntimeError(str(error)) from error
        finally:
            proxy.stop()


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        return int(probe.getsockname()[1])


def wait_for_port(port: int) -> None:
    """Return when a program listens; a connection would count as one of the load."""
    listening = re.compile(rf":{port:04X} \S+ 0A ")
    path = Path("/proc/net/tcp")
    wait_until(lambda: listening.search(path.read_text()), f"a program listens on port {port}")


class Load:
    """The load generator's process."""

    def __init__(self, mode: str, seconds: float, tls: Path | None = None, **more: object) -> None:
        job = {"mode": mode, "pairs": PAIRS, "tls": str(tls or ""),
               "rate_hz": RATE_HZ, "seconds": seconds,
               "size": SIZE, "cpu": cores()[1], "echo": 0, **more}  # fmt: skip
        self._process = subprocess.Popen(
            [sys.executable, "-m", "bench.relay_load"],
            text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        )  # fmt: skip
        self.tell(job)

    def tell(self, what: object) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps(what) + "\n")
        self._process.stdin.flush()

    def hear(self, key: str) -> dict[str, float]:
        assert self._process.stdout is not None
        answer: dict[str, float] = json.loads(self._process.stdout.readline() or "{}")
        if key not in answer:
            raise RuntimeError(f"the load generator answered {answer} instead of {key}")
        return answer

    def figures(
        self, relay_pid: int | None, during: Callable[[], object] = lambda: None
    ) -> Figures:
        """Return the figures of the run; ``during`` is called once it has warmed up."""
        self.hear("ready")
        self.hear("warm")
        during()
        begin_s = tree_cpu_s(relay_pid) if relay_pid is not None else 0.0
        self.hear("done")
        used_s = tree_cpu_s(relay_pid) - begin_s if relay_pid is not None else 0.0
        self.tell({})
        end = self.hear("count")
        self._process.wait(10)
        cpu_us = used_s * 1e6 / end["count"] if end["count"] else math.nan
        return Figures(end["p50_us"], end["p99_us"], cpu_us, end["longest_us"])


def measure_direct(seconds: float) -> Figures:
    load = Load("direct", seconds)
    load.hear("echo")
    return load.figures(None)


def measure_ours(seconds: float) -> Figures:
    with our_proxy() as (pid, air, ground):
        return Load("proxy", seconds, echo=air, send=ground).figures(pid)


def haproxy_command(folder: Path, port: int, echo: int) -> tuple[str, ...]:
    path = folder / "haproxy.cfg"
    path.write_text(
        "global\n  nbthread 1\n  maxconn 4000\ndefaults\n  mode tcp\n  timeout connect 5s\n"
        "  timeout client 60s\n  timeout server 60s\n"
        f"listen relay\n  bind 127.0.0.1:{port}\n  server echo 127.0.0.1:{echo}\n"
    )
    return ("haproxy", "-db", "-q", "-f", str(path))


def socat_command(folder: Path, port: int, echo: int) -> tuple[str, ...]:
    """Return socat's command line: a process for each connection."""
    return (
        "socat",
        f"TCP-LISTEN:{port},bind=127.0.0.1,reuseaddr,fork,nodelay,backlog=1024",
        f"TCP:127.0.0.1:{echo},nodelay",
    )


def measure_peer(name: str, seconds: float) -> Figures | None:
    """Measure HAProxy or socat; None if it is not installed."""
    if shutil.which(name) is None:
        return None
    command = haproxy_command if name == "haproxy" else socat_command
    load = Load("forward", seconds)
    echo = int(load.hear("echo")["echo"])
    port = free_port()
    with tempfile.TemporaryDirectory() as folder, pinned(*command(Path(folder), port, echo)) as it:
        wait_for_port(port)
        load.tell({"send": port})
        return load.figures(it.pid)


def relay_rows(rounds: int = ROUNDS, seconds: float = SECONDS) -> Iterable[Row]:
    """Yield latency and CPU against both peers, the rounds interleaved."""
    peers = {"haproxy": "HAProxy", "socat": "socat"}
    runs: dict[str, list[Figures]] = {name: [] for name in ("direct", "ours", *peers)}
    for _ in range(rounds):
        runs["direct"].append(measure_direct(seconds))
        runs["ours"].append(measure_ours(seconds))
        for name in peers:
            figures = measure_peer(name, seconds)
            if figures is not None:
                runs[name].append(figures)
    load = f"relay, {PAIRS} pairs x {RATE_HZ}/s x {SIZE} B"
    for name, label in peers.items():
        limit = TARGET if name == "haproxy" else None
        for share in ("p50", "p99"):
            added = {each: added_us(runs[each], runs["direct"], share) for each in ("ours", name)}
            what = f"{load}, added {share}"
            yield compared(what, "us", added["ours"], label, added[name], limit)
        ours, theirs = ([each.cpu_us for each in runs[key]] for key in ("ours", name))
        yield compared(f"{load}, CPU of a round trip", "us", ours, label, theirs, limit)


def added_us(runs: list[Figures], direct: list[Figures], share: str) -> list[float]:
    """Return how much a relay lengthens the round trip, in each round; empty if it never ran."""
    key = f"{share}_us"
    return [
        getattr(one, key) - getattr(floor, key) for one, floor in zip(runs, direct, strict=False)
    ]


def many_pairs_rows(pairs: int = MANY_PAIRS, seconds: int = 4) -> Iterable[Row]:
    """Yield the cost of many pairs: memory of an idle one, a core's share with their heartbeats."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    allowed = (hard - 200) // 2 if hard != resource.RLIM_INFINITY else pairs
    pairs = min(pairs, allowed)
    if soft != resource.RLIM_INFINITY:
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, 2 * pairs + 200), hard))
    with our_proxy() as (pid, air, ground):
        keep = [dial(air, "UP1 aircraft=warm\n"), dial(ground, "UP1 aircraft=warm\n")]
        before_mib = resident_mib(pid)
        for number in range(pairs):
            keep.append(dial(air, f"UP1 aircraft=idle-{number}\n"))
            keep.append(dial(ground, f"UP1 aircraft=idle-{number} seat=command\n"))
            if number % 500 == 0:
                beat(keep)
        each = (resident_mib(pid) - before_mib) * 2**20 / pairs
        shares = []
        begin_s = time.monotonic()
        for second in range(seconds):
            began_s, used_s = time.monotonic(), cpu_s(pid)
            beat(keep)
            time.sleep(max(0.0, begin_s + second + 1 - time.monotonic()))
            used_s = cpu_s(pid) - used_s
            shares.append(100 * used_s / (time.monotonic() - began_s))
        for peer in keep:
            peer.close()
    yield limited(f"relay, memory of an idle pair ({pairs} pairs)", "B", each, PAIR_BYTES_TARGET)
    what = f"relay, {pairs} pairs with a heartbeat a second from each end"
    limit = MANY_PAIRS_TARGET if pairs == MANY_PAIRS else None
    yield compared(what, "% of a core", shares, limit=limit)


def beat(peers: list[socket.socket]) -> None:
    """Send every peer's heartbeat, and read the received data."""
    for peer in peers:
        peer.send(b"\n")
    for peer in peers:
        with suppress(BlockingIOError):
            peer.recv(65536, socket.MSG_DONTWAIT)


def stalled_row(seconds: float = 2.0) -> Row:
    """Return how much a ground that does not read makes the proxy grow."""
    with our_proxy() as (pid, air, ground):
        aircraft = dial(air, "UP1 aircraft=stall\n")
        stalled = dial(ground, "UP1 aircraft=stall seat=command\n")
        before_mib = peak_mib = resident_mib(pid)
        sent = 0
        line = b"x" * 999 + b"\n"
        end_s = time.monotonic() + seconds
        while time.monotonic() < end_s:
            aircraft.sendall(line * 64)
            sent += 64_000
            peak_mib = max(peak_mib, resident_mib(pid))
        aircraft.close()
        stalled.close()
    grown_mb = (peak_mib - before_mib) * 2**20 / 1e6
    return Row(
        f"relay, memory behind a stalled ground ({sent / 1e6:.0f} MB sent)",
        f"{grown_mb:.2f} MB",
        "prototype (seen once)",
        "220 MB in 1 s",
        "",
        f"<= {STALL_MB_TARGET:g} MB",
        grown_mb <= STALL_MB_TARGET,
    )


def rows(quick: bool = False) -> Iterable[Row]:
    if shutil.which("taskset") is None:
        raise LeftOutError("taskset is not installed (Debian package util-linux)")
    if quick:
        yield from relay_rows(QUICK_ROUNDS, seconds=0.5)
        yield from many_pairs_rows(pairs=100, seconds=3)
        yield stalled_row(seconds=0.5)
        return
    yield from relay_rows()
    yield from many_pairs_rows()
    yield stalled_row()
