"""The proxy's TLS beside HAProxy's: added round trip, CPU, memory, handshakes, darkness.

Both relays decrypt and encrypt on both legs, with the same certificates; HAProxy resumes no
sessions either. Every figure is from one run on one machine.
"""

import os
import select
import shutil
import socket
import ssl
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from bench.daemon import MAIN, ROOT, write_config
from bench.processes import cpu_s, resident_mib, running
from bench.relay import (
    PAIRS,
    RATE_HZ,
    ROUNDS,
    SIZE,
    Figures,
    Load,
    added_us,
    free_port,
    measure_direct,
    our_proxy,
    pinned,
    wait_for_port,
)
from bench.relay_load import dial
from bench.table import LeftOutError, Row, compared, limited
from bench.timing import Limit
from up.config.keys_file import add_key
from up.protocols.pairing import Pairing
from up.tls.authority import Authority
from up.tls.files import TLSFiles
from up_ground.key_store import KeyStore
from up_simulator.harness.ports import choose_ports

TARGET = Limit(1.5)
PAIR_KIB_TARGET = 60.0
DARKNESS_TARGET_S = 3.0
STORM, STORM_LOAD_S, GOOD_PAIRS = 500, 2.0, 4
DARK_S, QUICK_DARK_S = 30.0, 5.0
RECONNECT = Path(__file__).with_name("tls_reconnect.py")
NAMESPACE = "up-bench-tls"
AIRCRAFT = "bench-0"
HERE, THERE = "10.249.7.1", "10.249.7.2"


@contextmanager
def certificates(pairs: int) -> Iterator[Path]:
    with tempfile.TemporaryDirectory() as folder:
        authority = Authority(Path(folder))
        authority.create("bench")
        authority.issue("relay", ["127.0.0.1", THERE], 2)
        authority.issue("client", [], 2)
        for number in range(pairs):
            authority.issue(f"bench-{number}", [], 2)
        yield authority.folder


def tls_settings(folder: Path) -> str:
    return f"tls: {{folder: {folder / 'relay'}, airborne port: 0, ground port: 0}}\n"


@contextmanager
def haproxy(folder: Path, port: int, echo: int, storm: int = 0) -> Iterator[int]:
    """Run HAProxy with TLS on both legs and yield its pid; ``storm`` has no server behind it."""
    own = folder / "relay"
    both = own / "both.pem"
    both.write_bytes((own / "certificate.pem").read_bytes() + (own / "key.pem").read_bytes())
    check = f"ca-file {own / 'ca.pem'} verify required"
    path = folder / "haproxy.cfg"
    bind = f"ssl crt {both} {check} no-tls-tickets"
    second = f"listen storm\n  bind 127.0.0.1:{storm} {bind}\n" if storm else ""
    path.write_text(
        "global\n  nbthread 1\n  maxconn 4000\n  tune.ssl.cachesize 0\ndefaults\n  mode tcp\n"
        "  timeout connect 5s\n  timeout client 60s\n  timeout server 60s\n"
        f"listen relay\n  bind 127.0.0.1:{port} {bind}\n"
        f"  server echo 127.0.0.1:{echo} ssl {check}\n{second}"
    )
    with pinned("haproxy", "-db", "-q", "-f", str(path)) as relay:
        wait_for_port(port)
        yield relay.pid


def measure_ours(seconds: float, own: Path) -> Figures:
    with our_proxy(tls_settings(own)) as (pid, air, ground):
        return Load("proxy", seconds, own, echo=air, send=ground).figures(pid)


def measure_haproxy(seconds: float, own: Path) -> Figures:
    load = Load("forward", seconds, own)
    echo = int(load.hear("echo")["echo"])
    port = free_port()
    with haproxy(own, port, echo) as pid:
        load.tell({"send": port})
        return load.figures(pid)


def relay_rows(rounds: int, seconds: float, own: Path) -> Iterable[Row]:
    runs: dict[str, list[Figures]] = {"direct": [], "ours": [], "haproxy": []}
    for _ in range(rounds):
        runs["direct"].append(measure_direct(seconds))
        runs["ours"].append(measure_ours(seconds, own))
        if shutil.which("haproxy") is not None:
            runs["haproxy"].append(measure_haproxy(seconds, own))
    load = f"TLS relay, {PAIRS} pairs x {RATE_HZ}/s x {SIZE} B"
    for share in ("p50", "p99"):
        added = {each: added_us(runs[each], runs["direct"], share) for each in ("ours", "haproxy")}
        limit = TARGET if share == "p50" else None
        yield compared(
            f"{load}, added {share}", "us", added["ours"], "HAProxy", added["haproxy"], limit
        )
    ours, theirs = ([each.cpu_us for each in runs[key]] for key in ("ours", "haproxy"))
    yield compared(f"{load}, CPU of a round trip", "us", ours, "HAProxy", theirs, TARGET)


def memory_row(pairs: int, own: Path) -> Row:
    client = TLSFiles(own / "client").client()
    with our_proxy(tls_settings(own)) as (pid, _, ground):

        def pair(number: int) -> list[socket.socket]:
            hello = f"UP1 aircraft=idle-{number} seat=listen\n"
            return [dial(ground, hello, client) for _ in range(2)]

        keep = pair(0)
        before_mib = resident_mib(pid)
        for number in range(pairs):
            keep += pair(number + 1)
            if number % 20 == 0:
                for peer in keep:
                    peer.send(b"\n")  # silent ones are closed
        each_kib = (resident_mib(pid) - before_mib) * 1024 / pairs
        for peer in keep:
            peer.close()
    what = f"TLS relay, memory of two idle connections ({pairs} pairs)"
    return limited(what, "KiB", each_kib, PAIR_KIB_TARGET)


def storm_s(port: int, pid: int, own: Path, count: int) -> tuple[float, float]:
    """Begin all handshakes together; return seconds until the last, CPU of the relay in ms each."""
    client = TLSFiles(own / "client").client()
    poll = select.epoll()
    waiting: dict[int, ssl.SSLSocket] = {}
    keep = []
    began_s, used_s = time.monotonic(), cpu_s(pid)
    for _ in range(count):
        peer = client.wrap_socket(
            socket.create_connection(("127.0.0.1", port)),
            server_hostname="127.0.0.1",
            do_handshake_on_connect=False,
        )
        peer.setblocking(False)
        poll.register(peer.fileno(), select.EPOLLIN)
        waiting[peer.fileno()] = peer
        keep.append(peer)
        with suppress(ssl.SSLWantReadError):
            peer.do_handshake()
    while waiting:
        for descriptor, _ in poll.poll(30) or [(-1, 0)]:
            with suppress(ssl.SSLWantReadError):
                waiting[descriptor].do_handshake()
                del waiting[descriptor]
                poll.unregister(descriptor)
    # The last answers of the clients are still on their way.
    took_s = time.monotonic() - began_s
    time.sleep(0.3)
    used_ms = (cpu_s(pid) - used_s) * 1000 / count
    for peer in keep:
        peer.close()
    return took_s, used_ms


def storm_rows(rounds: int, own: Path) -> Iterable[Row]:
    """Yield what a storm costs, and the round trips of good peers relayed during it."""
    ours, theirs = [], []
    for _ in range(rounds):
        with our_proxy(tls_settings(own)) as (pid, air, ground):
            load = Load("proxy", STORM_LOAD_S, own, pairs=GOOD_PAIRS, echo=air, send=ground)
            ours.append(storm(load, ground, pid, own))
        if shutil.which("haproxy") is not None:
            load = Load("forward", STORM_LOAD_S, own, pairs=GOOD_PAIRS)
            echo = int(load.hear("echo")["echo"])
            port, stormed = free_port(), free_port()
            with haproxy(own, port, echo, stormed) as pid:
                load.tell({"send": port})
                theirs.append(storm(load, stormed, pid, own))
    what = f"TLS relay, storm of {STORM} handshakes"
    for index, (name, unit, limit) in enumerate(
        (
            ("until the last", "s", None),
            ("CPU of one", "ms", TARGET),
            (f"p50 of {GOOD_PAIRS} good pairs", "ms", TARGET),
            (f"standstill of {GOOD_PAIRS} good pairs (longest round trip)", "ms", TARGET),
        )
    ):
        mine, others = ([run[index] for run in runs] for runs in (ours, theirs))
        yield compared(f"{what}, {name}", unit, mine, "HAProxy", others, limit)


def storm(load: Load, port: int, pid: int, own: Path) -> tuple[float, ...]:
    """Return the figures of a storm on a relay under load, in the order of the rows."""
    found: list[float] = []
    trips = load.figures(pid, lambda: found.extend(storm_s(port, pid, own, STORM)))
    return (*found, trips.p50_us / 1000, trips.longest_us / 1000)


@contextmanager
def dark_network() -> Iterator[tuple[str, ...]]:
    """Make a namespace behind a veth pair; yield the prefix of a command inside."""
    inside = ("ip", "netns", "exec", NAMESPACE)
    if os.geteuid() or not all(map(shutil.which, ("ip", "nft"))):
        raise LeftOutError("darkness needs root, iproute2 and nftables")
    try:
        for words in (
            f"ip netns add {NAMESPACE}",
            "ip link add upbt0 type veth peer name upbt1",
            f"ip link set upbt1 netns {NAMESPACE}",
            f"ip addr add {HERE}/24 dev upbt0",
            "ip link set upbt0 up",
            f"{' '.join(inside)} ip addr add {THERE}/24 dev upbt1",
            f"{' '.join(inside)} ip link set upbt1 up",
        ):
            subprocess.run(words.split(), check=True, capture_output=True)
        yield inside
    finally:
        subprocess.run(("ip", "link", "del", "upbt0"), capture_output=True, check=False)
        subprocess.run(("ip", "netns", "del", NAMESPACE), capture_output=True, check=False)


def reconnect_row(dark_s: float, rounds: int, own: Path) -> Row:
    """Return how long after the end of darkness the ground reads telemetry again.

    A real daemon and a real ground link, both with TLS and keys, lose the proxy together.
    """
    ports, took_s = choose_ports(any_ports=True), []
    tls = (
        f"{{folder: {own / 'relay'}, airborne port: {ports.airborne}, ground port: {ports.ground}}}"
    )
    with tempfile.TemporaryDirectory() as name, dark_network() as inside:
        folder = Path(name)
        (folder / "proxy.yml").write_text(f"metrics: false\ntls: {tls}\n")
        write_config(folder, ports)
        (folder / "mission_control.yml").write_text(
            f"aircraft: {AIRCRAFT}\nremote_server:\n  url: {THERE}\n  port: {ports.airborne}\n"
            f"  tls: {own / AIRCRAFT}\n  security: require\n"
        )
        key_id, key = add_key(folder, "bench", "pilot")
        KeyStore(folder).put(Pairing(AIRCRAFT, key_id, key.secret, key.role, key.name))
        proxy = (*inside, sys.executable, "-m", "up_proxy.main", "--config", folder)
        words = (THERE, str(ports.ground), own / "client", folder, str(dark_s), " ".join(inside))
        with (
            (folder / "log").open("w") as log,
            running(proxy, log, ROOT),
            running((sys.executable, MAIN, "--config", folder), log, ROOT),
        ):
            for _ in range(rounds):
                done = subprocess.run(
                    (sys.executable, RECONNECT, *words),
                    capture_output=True,
                    text=True,
                    timeout=dark_s + 120,
                )
                if done.returncode or not done.stdout:
                    reason = done.stderr.strip() or "it never connected again"
                    raise RuntimeError(reason.splitlines()[-1])
                took_s.append(float(done.stdout))
    what = f"TLS and envelope, a frame read after {dark_s:g} s of darkness, worst of {rounds}"
    return limited(what, "s", max(took_s), DARKNESS_TARGET_S)


def rows(quick: bool = False) -> Iterable[Row]:
    if shutil.which("taskset") is None:
        raise LeftOutError("taskset is not installed (Debian package util-linux)")
    with certificates(PAIRS) as own:
        yield from relay_rows(3 if quick else ROUNDS, 0.5 if quick else 3.0, own)
        yield memory_row(100 if quick else 400, own)
        yield from storm_rows(1 if quick else 5, own)
        yield reconnect_row(QUICK_DARK_S if quick else DARK_S, 1 if quick else 3, own)
