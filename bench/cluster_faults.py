"""Three relays on three hosts under load: cut off, killed, restarted, and overrun by aircraft."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from bench.cluster_search import search_rows
from bench.table import LeftOutError, Row, limited
from bench.timing import percentile
from tests.proxy.cluster.nodes import Nodes
from tests.proxy.cluster.traffic import Traffic
from tests.support.hosts import Hosts
from tests.support.nats_servers import NatsServers
from tests.support.reactor import run_in_reactor, sleep, until

LIMITS = (
    "limits:\n  connections per side: 6000\n  connections per address: 6000\n  aircraft: 6000\n"
)
LIMIT_S = 120.0
PARTITION_S = 10.0
ROUNDS, QUICK_ROUNDS = 3, 1
PAIRS, QUICK_PAIRS = 200, 20
RESTARTS, QUICK_RESTARTS = 30, 3
STORM, QUICK_STORM = 5000, 100
STORM_PAIRS, STORM_PERIOD_S = 18, 0.2
"""Pairs that are measured during the storm, and the period of their Commands."""
OUTAGE_S = 20.0
RESTART_PAIRS = 60
SEARCHES, QUICK_SEARCHES = 200, 2
BACK_S, ELSEWHERE_S, NEW_LEASE_S, AGE_S = 3.0, 1.0, 10.0, 2.0
STORM_BACK_S, STORM_P99_MS, STORM_MB = 30.0, 100.0, 1500.0
MANY_PERIOD_S = 0.5
"""Of frames and of Commands of each of the pairs: all programs share the cores."""
ACCESS_NETWORK = 3
"""The host from which the aircraft of the storm come."""


@contextmanager
def cluster(hosts: int = 3) -> Iterator[tuple[Any, Any, Any]]:
    """Run servers and proxies, each on its host; without hosts on this machine."""
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        network = stack.enter_context(Hosts(hosts)) if hosts else None
        servers = stack.enter_context(NatsServers(folder, network=network))
        yield network, servers, stack.enter_context(Nodes(servers, folder, more=LIMITS))


def fault_rows(what: str, traffic: Traffic, seconds: int = 0) -> Iterable[Row]:
    """Yield what may not happen in any fault; `seconds`: second aircraft of a name."""
    faults = traffic.faults
    total = sum(len(each.acknowledged) for each in traffic.grounds)
    counts = {
        "two owners": faults.double_owners,
        "second aircraft": seconds,
        "wrong aircraft": faults.misdirected,
        "lines repeated": faults.repeated,
        f"lost of {total} acknowledged Commands": len(traffic.unexecuted()),
    }
    text = ", ".join(f"{count} {name}" for name, count in counts.items())
    yield Row(f"{what}: violations", text, target="0", met=not any(counts.values()))
    oldest_s = max(each.oldest_s for each in traffic.grounds)
    yield limited(f"{what}: oldest frame", "s", oldest_s, AGE_S)


def longest_s(grounds: Iterable[Any]) -> float:
    """Return the longest time without a frame or an acknowledgement."""
    return max(max(each.frames.longest_s, each.answers.longest_s) for each in grounds)


def has_relayed(grounds: Iterable[Any]) -> bool:
    return all(min(each.frames.count, each.answers.count) > 1 for each in grounds)


async def all_relay(grounds: Iterable[Any]) -> None:
    """Reset the gaps, and wait until every ground gets frames and acknowledgements."""
    grounds = list(grounds)
    reset_gaps(grounds)
    await until(lambda: has_relayed(grounds), LIMIT_S)


def reset_gaps(grounds: Iterable[Any]) -> None:
    for each in grounds:
        each.frames.reset()
        each.answers.reset()


def partition_rows(rounds: int) -> Iterable[Row]:
    with cluster() as (network, servers, nodes):
        for what, offset in (("of a home of aircraft", 1), ("of the leader of the leases", 0)):
            traffic, figures = Traffic(nodes), Partitions()
            for number in range(rounds):
                cut = (servers.leader("KV_up-leases") + offset) % 3
                run_in_reactor(partition, network, traffic, cut, number, figures, timeout_s=600)
            what = f"cluster, partition {what}, worst of {rounds}"
            yield limited(f"{what}: gap of pairs on one side", "s", figures.gap_s, ELSEWHERE_S)
            yield limited(f"{what}: next new lease", "s", figures.new_lease_s, NEW_LEASE_S)
            back = f"{figures.back_s:.2f} s"
            yield Row(f"{what}: pairs of both sides relay again, from its end", back)
            yield from fault_rows(what, traffic, figures.seconds)


class Partitions:
    """The worst figures of some partitions."""

    gap_s = new_lease_s = back_s = 0.0
    seconds = 0
    """Aircraft that were accepted under the name of one that was cut off."""


async def partition(
    network: Any, traffic: Traffic, cut: int, number: int, figures: Partitions
) -> None:
    """Cut a host off for 10 s; the peers of this round leave at its end."""
    one, other = (node for node in range(3) if node != cut)
    ways = [(node, node) for node in range(3)] + [(one, other), (other, one)]
    begin = len(traffic.grounds)
    for air, ground in (*ways, (cut, one), (other, cut)):
        traffic.pair(air, ground, f"{cut}-{number}-{air}{ground}")
    beside, across = (
        traffic.grounds[begin : begin + len(ways)],
        traffic.grounds[begin + len(ways) :],
    )
    await all_relay((*beside, *across))
    reset_gaps(beside)
    network.isolate(cut)
    began_s = time.monotonic()
    probes = [traffic.add_aircraft(node, f"{cut}-{number}-new{node}") for node in (one, other)]
    second = traffic.add_aircraft(one, f"{cut}-{number}-{cut}{one}")
    for each in (*probes, second):
        each.stays = True
    await until(lambda: all(each.is_open for each in probes), LIMIT_S)
    figures.new_lease_s = max(figures.new_lease_s, *(each.opened_s - began_s for each in probes))
    await sleep(max(0.0, began_s + PARTITION_S - time.monotonic()))
    figures.gap_s = max(figures.gap_s, longest_s(beside))
    figures.seconds += second.connects
    second.stop()
    healed_s = time.monotonic()
    network.heal()
    await all_relay(across)
    figures.back_s = max(figures.back_s, time.monotonic() - healed_s)
    # The servers' logs of the leases are equal again.
    await sleep(PARTITION_S)
    figures.gap_s = max(figures.gap_s, longest_s(beside))
    for peer in (*traffic.grounds[begin:], *traffic.aircraft):
        peer.stop()
    await sleep(0.1)


def kill_rows(pairs: int) -> Iterable[Row]:
    with cluster() as (_, _, nodes):
        traffic = Traffic(nodes, MANY_PERIOD_S)
        dead_s, beside_s = run_in_reactor(kill, nodes, traffic, pairs, timeout_s=600)
    what = f"cluster, kill -9 of a node with {pairs} pairs"
    yield limited(f"{what}: longest gap of its sessions", "s", dead_s, BACK_S)
    yield limited(f"{what}: longest gap elsewhere", "s", beside_s, ELSEWHERE_S)
    yield from fault_rows(what, traffic)


async def kill(nodes: Nodes, traffic: Traffic, pairs: int) -> tuple[float, float]:
    """Kill node 0; return the longest gap of its sessions, and of the others."""
    for number in range(pairs):
        # The aircraft, its ground, or both are at the node that ends.
        air, ground = ((0, 0), (0, 1), (2, 0))[number % 3]
        traffic.pair(air, ground, f"dead-{number}")
    for number in range(pairs // 4):
        traffic.pair(1 + number % 2, 1 + number // 2 % 2, f"beside-{number}")
    dead, beside = traffic.grounds[:pairs], traffic.grounds[pairs:]
    await all_relay(traffic.grounds)
    await sleep(5.0)
    nodes.programs[0].process.kill()
    await all_relay(traffic.grounds)
    await sleep(5.0)
    gaps = longest_s(dead), longest_s(beside)
    traffic.stop()
    await sleep(0.1)
    return gaps


def restart_rows(restarts: int, pairs: int) -> Iterable[Row]:
    with cluster() as (_, _, nodes):
        traffic = Traffic(nodes, MANY_PERIOD_S)
        gap_s = run_in_reactor(roll, nodes, traffic, restarts, pairs, timeout_s=3600)
    what = f"cluster, {restarts} rolling restarts with {pairs} pairs"
    sent = sum(each.sent for each in traffic.grounds)
    acknowledged = sum(len(each.acknowledged) for each in traffic.grounds)
    yield limited(f"{what}: longest gap of a pair", "s", gap_s, BACK_S)
    yield Row(f"{what}: Commands without an answer", f"{sent - acknowledged} of {sent}")
    yield from fault_rows(what, traffic)


async def roll(nodes: Nodes, traffic: Traffic, restarts: int, pairs: int) -> float:
    """Stop and start one node after the other; return the longest gap of a pair."""
    for number in range(pairs):
        traffic.pair(number % 3, number // 3 % 3, f"roll-{number}")
    await all_relay(traffic.grounds)
    gap_s = 0.0
    for number in range(restarts):
        program = nodes.programs[number % 3]
        program.process.send_signal(signal.SIGTERM)
        await until(lambda program=program: program.process.poll() is not None, LIMIT_S)
        nodes.start(number % 3)
        await until(lambda n=number: nodes.is_ready(nodes.programs[n % 3]), LIMIT_S)
        await until(lambda: has_relayed(traffic.grounds), LIMIT_S)
        gap_s = max(gap_s, longest_s(traffic.grounds))
        await all_relay(traffic.grounds)
    traffic.stop()
    await sleep(0.1)
    return gap_s


def storm_rows(count: int) -> Iterable[Row]:
    with cluster(hosts=4) as (network, _, nodes), tempfile.TemporaryFile("w+b") as states:
        job = {
            "hosts": [nodes.host(node) for node in range(3)],
            "ports": [program.airborne_port for program in nodes.programs],
            "count": count,
        }
        command = [*network.prefixes[ACCESS_NETWORK], sys.executable, "-m", "bench.cluster_storm"]
        child = subprocess.Popen([*command, json.dumps(job)], stdout=states)
        traffic, storm = Traffic(nodes, STORM_PERIOD_S), Storm(states, count)
        try:
            run_in_reactor(outage, network, nodes, traffic, storm, timeout_s=1200)
        finally:
            child.kill()
            child.wait()
    what = f"cluster, {count} aircraft connect again after {OUTAGE_S:g} s without a network"
    yield limited(f"{what}: all back", "s", storm.back_s, STORM_BACK_S)
    yield limited(f"{what}: memory of the largest node", "MB", storm.largest_mb, STORM_MB)
    p99_ms = storm.p99_ms(traffic)
    pairs = f"{what}: p99 round trip of {len(traffic.grounds)} pairs"
    yield limited(pairs, "ms", p99_ms, STORM_P99_MS)
    yield Row(f"{pairs}, before", f"{storm.before_p99_ms:.1f} ms")
    yield from fault_rows(what, traffic)


class Storm:
    """The state of the aircraft, which another process has, and what the storm did."""

    back_s = largest_mb = before_p99_ms = 0.0

    def __init__(self, states: Any, count: int) -> None:
        self._states = states
        self.count = count

    def connected(self) -> int:
        """Return how many are connected now; 0 before the first report."""
        self._states.flush()
        size = os.fstat(self._states.fileno()).st_size
        lines = os.pread(self._states.fileno(), 64, max(0, size - 64)).split(b"\n")
        return int(lines[-2]) if len(lines) > 1 else 0

    def weigh(self, nodes: Nodes) -> None:
        self.largest_mb = max(self.largest_mb, *(p.rss_bytes() / 1e6 for p in nodes.programs))

    @staticmethod
    def p99_ms(traffic: Traffic) -> float:
        trips_s = sorted(trip for each in traffic.grounds for trip in each.round_trips_s)
        return percentile(trips_s, 0.99) * 1000


async def outage(network: Any, nodes: Nodes, traffic: Traffic, storm: Storm) -> None:
    await until(lambda: storm.connected() == storm.count, 300.0)
    for number in range(STORM_PAIRS):
        traffic.pair(number % 3, number // 3 % 3, f"pair-{number}")
    await all_relay(traffic.grounds)
    await sleep(OUTAGE_S)
    storm.before_p99_ms = storm.p99_ms(traffic)
    network.isolate(ACCESS_NETWORK)
    await sleep(OUTAGE_S)
    await until(lambda: storm.connected() == 0, LIMIT_S)
    for each in traffic.grounds:
        each.round_trips_s.clear()
    healed_s = time.monotonic()
    network.heal()
    while storm.connected() < storm.count:
        storm.weigh(nodes)
        await sleep(0.1)
    storm.back_s = time.monotonic() - healed_s
    storm.weigh(nodes)
    traffic.stop()
    await sleep(0.1)


def rows(quick: bool = False) -> Iterable[Row]:
    for tool in ("ip", "nft"):
        if os.geteuid() or shutil.which(tool) is None:
            raise LeftOutError(f"needs root and {tool}")
    yield from partition_rows(QUICK_ROUNDS if quick else ROUNDS)
    yield from kill_rows(QUICK_PAIRS if quick else PAIRS)
    restarts = (QUICK_RESTARTS, QUICK_PAIRS) if quick else (RESTARTS, RESTART_PAIRS)
    yield from restart_rows(*restarts)
    yield from storm_rows(QUICK_STORM if quick else STORM)
    for subject in ("leases", "relays"):
        yield from search_rows(subject, QUICK_SEARCHES if quick else SEARCHES)
