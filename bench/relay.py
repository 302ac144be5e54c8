"""The proxy beside HAProxy and socat: added round trip, CPU, memory.

Relay and load generator are processes of their own, on a core each where there are two; every
figure is from one run on one machine.
"""

import json
import os
import re
import resource
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from bench.table import Row

PAIRS = 100
RATE_HZ = 50
SIZE = 200
SECONDS = 5.0
ROUNDS = 3
LATENCY_TARGET = 1.5
CPU_TARGET = 1.3
PAIR_BYTES_TARGET = 4096
MANY_PAIRS = 5000
STALL_BYTES_TARGET = 5_000_000
LOAD = Path(__file__).with_name("relay_load.py")
DEADLINE_S = 60.0
LISTENS = r"(airborne|ground) side listens on port (\d+)\n"


@dataclass(frozen=True, slots=True)
class Figures:
    """Round trips in microseconds, CPU of the relay in microseconds a round trip."""

    p50_us: float
    p99_us: float
    cpu_us: float


def tree(pid: int) -> list[int]:
    """Return a process and all its descendants."""
    found = [pid]
    for task in Path(f"/proc/{pid}/task").iterdir():
        for child in (task / "children").read_text().split():
            found += tree(int(child))
    return found


def cpu_s(pid: int) -> float:
    """Return the CPU time of a process with its descendants, all threads, in seconds."""
    total_ns = 0
    for each in tree(pid):
        for task in Path(f"/proc/{each}/task").iterdir():
            total_ns += int((task / "schedstat").read_text().split()[0])
    return total_ns / 1e9


def resident_bytes(pid: int) -> int:
    """Return the resident memory of a process."""
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def cores() -> tuple[int, int]:
    """Return the cores of relay and load generator."""
    allowed = sorted(os.sched_getaffinity(0))
    return allowed[0], allowed[-1]


@contextmanager
def process(*command: str, stderr: IO[str] | None = None) -> Iterator[subprocess.Popen[str]]:
    """Run a program on the relay's core, and end it."""
    relay_core, _ = cores()
    running = subprocess.Popen(
        ["taskset", "-c", str(relay_core), *command], text=True, stderr=stderr
    )
    try:
        yield running
    finally:
        running.terminate()
        try:
            running.wait(5)
        except subprocess.TimeoutExpired:
            running.kill()
            running.wait()


@contextmanager
def our_proxy(folder: Path) -> Iterator[tuple[subprocess.Popen[str], int, int]]:
    """Run up-proxy on free ports; yield it with its airborne and ground port."""
    (folder / "proxy.yml").write_text(
        "limits:\n  connections per side: 6000\n  connections per address: 6000\n"
        "  aircraft: 6000\nmetrics: false\n"
    )
    command = (sys.executable, "-m", "up_proxy.main", "--config", str(folder),
               "--airborne-port", "0", "--ground-port", "0")  # fmt: skip
    log = folder / "log"
    with log.open("w") as stream, process(*command, stderr=stream) as running:
        deadline_s = time.monotonic() + DEADLINE_S
        while True:
            ports = dict(re.findall(LISTENS, log.read_text()))
            if len(ports) == 2:
                break
            if time.monotonic() > deadline_s or running.poll() is not None:
                raise RuntimeError("up-proxy did not start")
            time.sleep(0.02)
        yield running, int(ports["airborne"]), int(ports["ground"])


def free_port() -> int:
    """Return a port that is free at this moment."""
    with socket.create_server(("127.0.0.1", 0)) as probe:
        return int(probe.getsockname()[1])


def wait_for_port(port: int) -> None:
    """Return when somebody listens."""
    deadline_s = time.monotonic() + DEADLINE_S
    while time.monotonic() < deadline_s:
        if f":{port:04X} " in "".join(
            line for line in Path("/proc/net/tcp").read_text().splitlines(True) if " 0A " in line
        ):
            return
        time.sleep(0.02)
    raise RuntimeError(f"nobody listens on port {port}")


class Load:
    """The load generator's process."""

    def __init__(self, mode: str, seconds: float, **ports: int) -> None:
        job = {"mode": mode, "pairs": PAIRS, "rate_hz": RATE_HZ, "seconds": seconds,
               "size": SIZE, "cpu": cores()[1], "echo": 0, **ports}  # fmt: skip
        self._process = subprocess.Popen(
            [sys.executable, str(LOAD)], text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        self.tell(job)

    def tell(self, what: object) -> None:
        """Write one JSON line to it."""
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps(what) + "\n")
        self._process.stdin.flush()

    def hear(self, key: str) -> dict[str, float]:
        """Return its next line, which must have `key`."""
        assert self._process.stdout is not None
        answer: dict[str, float] = json.loads(self._process.stdout.readline() or "{}")
        if key not in answer:
            raise RuntimeError(f"the load generator said {answer} in place of {key}")
        return answer

    def figures(self, relay_pid: int | None) -> Figures:
        """Wait for the measurement and return it."""
        self.hear("ready")
        self.hear("warm")
        begin_s = cpu_s(relay_pid) if relay_pid is not None else 0.0
        self.hear("done")
        used_s = cpu_s(relay_pid) - begin_s if relay_pid is not None else 0.0
        self.tell({})
        end = self.hear("count")
        self._process.wait(10)
        return Figures(end["p50_us"], end["p99_us"], used_s * 1e6 / end["count"])


def measure_direct(seconds: float) -> Figures:
    """Measure the load generator against itself."""
    load = Load("direct", seconds)
    load.hear("echo")
    return load.figures(None)


def measure_ours(seconds: float) -> Figures:
    """Measure up-proxy."""
    with tempfile.TemporaryDirectory() as folder, our_proxy(Path(folder)) as (running, air, ground):
        return Load("proxy", seconds, echo=air, send=ground).figures(running.pid)


def haproxy_command(folder: Path, port: int, echo: int) -> tuple[str, ...]:
    """Return HAProxy's command line: one thread, TCP mode."""
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
    """Measure HAProxy or socat; None when it is not installed."""
    if shutil.which(name) is None:
        return None
    command = haproxy_command if name == "haproxy" else socat_command
    load = Load("forward", seconds)
    echo = int(load.hear("echo")["echo"])
    port = free_port()
    with tempfile.TemporaryDirectory() as folder, process(*command(Path(folder), port, echo)) as it:
        wait_for_port(port)
        load.tell({"send": port})
        return load.figures(it.pid)


def best(rounds: list[Figures]) -> Figures:
    """Return the quietest figures of several rounds: noise only ever adds."""
    return Figures(
        min(each.p50_us for each in rounds),
        min(each.p99_us for each in rounds),
        min(each.cpu_us for each in rounds),
    )


def relay_rows(rounds: int = ROUNDS, seconds: float = SECONDS) -> Iterable[Row]:
    """Yield latency and CPU against both peers, the rounds interleaved."""
    names = [name for name in ("haproxy", "socat") if shutil.which(name)]
    runs: dict[str, list[Figures]] = {name: [] for name in ("direct", "ours", *names)}
    for _ in range(rounds):
        runs["direct"].append(measure_direct(seconds))
        runs["ours"].append(measure_ours(seconds))
        for name in names:
            figures = measure_peer(name, seconds)
            if figures is not None:
                runs[name].append(figures)
    direct, ours = best(runs["direct"]), best(runs["ours"])
    load = f"{PAIRS} pairs x {RATE_HZ}/s x {SIZE} B"
    for name in ("haproxy", "socat"):
        label = {"haproxy": "HAProxy", "socat": "socat"}[name]
        if name not in runs:
            yield Row(f"relay, {load}", f"{ours.cpu_us:.1f} us CPU", label, "not installed")
            continue
        peer = best(runs[name])
        aim = name == "haproxy"
        for what, mine, theirs, target in (
            ("added p50", ours.p50_us - direct.p50_us, peer.p50_us - direct.p50_us, LATENCY_TARGET),
            ("added p99", ours.p99_us - direct.p99_us, peer.p99_us - direct.p99_us, LATENCY_TARGET),
            ("CPU a round trip", ours.cpu_us, peer.cpu_us, CPU_TARGET),
        ):
            ratio = mine / theirs if theirs > 0 else float("inf")
            yield Row(
                f"relay, {load}, {what}",
                f"{mine:.1f} us",
                label,
                f"{theirs:.1f} us",
                f"{ratio:.2f}x",
                f"<= {target}x" if aim else "",
                ratio <= target if aim else None,
            )


def dial(port: int, hello: str) -> socket.socket:
    """Connect to the proxy and say hello."""
    peer = socket.create_connection(("127.0.0.1", port))
    peer.sendall(hello.encode("ascii"))
    if not peer.recv(4096).startswith(b"UP1 ok"):
        raise RuntimeError("the proxy refused the benchmark")
    return peer


def many_pairs_rows(pairs: int = MANY_PAIRS, seconds: int = 4) -> Iterable[Row]:
    """Yield what many pairs cost: memory of an idle one, a core's share with their heartbeats."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    allowed = (hard - 200) // 2 if hard != resource.RLIM_INFINITY else pairs
    pairs = min(pairs, allowed)
    if soft != resource.RLIM_INFINITY:
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, 2 * pairs + 200), hard))
    with tempfile.TemporaryDirectory() as folder, our_proxy(Path(folder)) as (running, air, ground):
        keep = [dial(air, "UP1 aircraft=warm\n"), dial(ground, "UP1 aircraft=warm\n")]
        before = resident_bytes(running.pid)
        for number in range(pairs):
            keep.append(dial(air, f"UP1 aircraft=idle-{number}\n"))
            keep.append(dial(ground, f"UP1 aircraft=idle-{number} seat=command\n"))
            if number % 500 == 0:
                beat(keep)
        each = (resident_bytes(running.pid) - before) / pairs
        begin_s, begin_cpu_s = time.monotonic(), cpu_s(running.pid)
        for second in range(seconds):
            beat(keep)
            time.sleep(max(0.0, begin_s + second + 1 - time.monotonic()))
        share = (cpu_s(running.pid) - begin_cpu_s) / (time.monotonic() - begin_s)
        for peer in keep:
            peer.close()
    yield Row(
        f"relay, memory of an idle pair ({pairs} pairs)",
        f"{each:.0f} B",
        target=f"<= {PAIR_BYTES_TARGET} B",
        met=each <= PAIR_BYTES_TARGET,
    )
    yield Row(
        f"relay, {pairs} pairs with a heartbeat a second from each end",
        f"{share:.0%} of a core",
        target=f"{MANY_PAIRS} pairs on a core",
        met=pairs >= MANY_PAIRS and share < 1,
    )


def beat(peers: list[socket.socket]) -> None:
    """Send every peer's heartbeat, and read what came."""
    for peer in peers:
        peer.send(b"\n")
    for peer in peers:
        with suppress(BlockingIOError):
            peer.recv(65536, socket.MSG_DONTWAIT)


def stalled_row(seconds: float = 2.0) -> Row:
    """Return by how much a ground that does not read makes the proxy grow."""
    with tempfile.TemporaryDirectory() as folder, our_proxy(Path(folder)) as (running, air, ground):
        aircraft = dial(air, "UP1 aircraft=stall\n")
        stalled = dial(ground, "UP1 aircraft=stall seat=command\n")
        before = resident_bytes(running.pid)
        peak, sent = before, 0
        line = b"x" * 999 + b"\n"
        end_s = time.monotonic() + seconds
        while time.monotonic() < end_s:
            aircraft.sendall(line * 64)
            sent += 64_000
            peak = max(peak, resident_bytes(running.pid))
        aircraft.close()
        stalled.close()
    grown = peak - before
    return Row(
        f"relay, memory behind a stalled ground ({sent / 1e6:.0f} MB sent)",
        f"{grown / 1e6:.2f} MB",
        "prototype (seen once)",
        "220 MB in 1 s",
        "",
        f"<= {STALL_BYTES_TARGET / 1e6:.0f} MB",
        grown <= STALL_BYTES_TARGET,
    )


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield the relay's rows of the table."""
    if quick:
        yield from relay_rows(rounds=1, seconds=1.0)
        yield from many_pairs_rows(pairs=100, seconds=1)
        yield stalled_row(seconds=0.5)
        return
    yield from relay_rows()
    yield from many_pairs_rows()
    yield stalled_row()
