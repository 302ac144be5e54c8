"""Three proxies on three NATS servers: the hop between nodes, the loss of a leader or a host."""

import itertools
import math
import os
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any
from unittest.mock import patch

from bench.cluster_faults import all_relay, cluster, longest_s, reset_gaps
from bench.processes import tree
from bench.relay import RATE_HZ, Load, beat, cores, tree_cpu_s
from bench.relay_load import dial
from bench.table import Row, compared, limited
from bench.timing import Limit
from tests.proxy.cluster.traffic import Traffic
from tests.runner.pool.runner_pool import RunnerPool, doubles, lives
from tests.support.nats_servers import NatsServers
from tests.support.reactor import run_in_reactor
from tests.support.reactor import until as until_later
from tests.support.waiting import until

ROUNDS, QUICK_ROUNDS = 5, 1
SECONDS, QUICK_SECONDS = 5.0, 1.0
ADDED_P50_US, ADDED_P99_US = 800.0, 3000.0
CPU_RATIO, CPU_RATIO_WITH_NATS = 2.2, 3.7
GAP_S, NEW_LEASE_S = 1.0, 10.0
INSTANCES, QUICK_INSTANCES = 50, 5
"""Of the tests' application, which starts in a third of the time of Raspilot."""
LEASE_S = 10
"""The default of `runner.yml: pool: lease`."""
ELSEWHERE_S = 15.0
DEADLINE_S = 60.0
FULL = "full load"
LOADS = {"10 lines/s": 10, f"{RATE_HZ} lines/s": RATE_HZ, FULL: 1000}
"""Round trips a second of each of the 100 pairs; the last is more than the relays can do."""
IDLE_PAIRS, IDLE_SECONDS, IDLE_SETTLE_S = 500, 10, 6
"""The leases of one period are written meanwhile."""
RUNS = itertools.count()
"""The names of a run are taken for 3 s after it."""


def hop_rows(servers: Any, nodes: Any, rounds: int, seconds: float) -> Iterable[Row]:
    """Yield the hop between two nodes beside pairs of one node, the rounds interleaved.

    Each of two nodes has half of the aircraft and half of the grounds, and all that differs is
    which ones: the relays have equal caches. They have a core; NATS servers and load have the
    other one.
    """
    relays = [program.pid for program in nodes.programs[:2]]
    nats = [process.pid for process in servers.processes]
    local, across = ({load: [] for load in LOADS} for _ in range(2))
    with pinned({0: relays, 1: nats}):
        for _ in range(rounds):
            for load, rate_hz in LOADS.items():
                for found, is_across in ((local, False), (across, True)):
                    run = round_trips(nodes, is_across, rate_hz, relays, nats, seconds)
                    found[load].append(run)
    for load in LOADS:
        near, far = local[load], across[load]
        if load != FULL:  # there a line waits for those of all other pairs
            for i, share, limit in ((0, "p50", ADDED_P50_US), (1, "p99", ADDED_P99_US)):
                added = [each[i] - least[i] for least, each in zip(near, far, strict=True)]
                what = f"cluster, {load}: added {share} of a line"
                yield compared(what, "us", added, limit=Limit(limit))
        for what, parts, limit in (
            ("relays", slice(2, 3), CPU_RATIO),
            ("relays and NATS servers", slice(2, 4), CPU_RATIO_WITH_NATS),
        ):
            ours, least_us = ([sum(run[parts]) for run in runs] for runs in (far, near))
            name = f"cluster, {load}: CPU of a round trip, {what}"
            # At full load they relay at different rates: more lines come together at one node.
            judged = None if load == FULL else Limit(limit)
            yield compared(name, "us", ours, "pairs of one node", least_us, judged)


@contextmanager
def pinned(pids: Mapping[int, Iterable[int]]) -> Iterator[None]:
    """Keep processes on the first (0) or the last core (1) until the end."""
    every = os.sched_getaffinity(0)
    try:
        for which, parents in pids.items():
            move(parents, {cores()[which]})
        yield
    finally:
        for parents in pids.values():
            move(parents, every)


def move(parents: Iterable[int], allowed: set[int]) -> None:
    """Let all threads of the processes and of their children run on these cores."""
    for pid in itertools.chain.from_iterable(map(tree, parents)):
        for thread in Path(f"/proc/{pid}/task").iterdir():
            with suppress(ProcessLookupError):
                os.sched_setaffinity(int(thread.name), allowed)


def round_trips(
    nodes: Any,
    is_across: bool,
    rate_hz: int,
    relays: list[int],
    nats: list[int],
    seconds: float,
) -> tuple[float, float, float, float]:
    """Return p50 and p99 of one way, CPU of relays and of NATS of a round trip; microseconds."""
    pairs = zip(
        nodes.programs[:2], nodes.programs[1::-1] if is_across else nodes.programs[:2], strict=True
    )
    ports = [(ground.ground_port, air.airborne_port) for air, ground in pairs]
    more = {"nodes": ports, "rate_hz": rate_hz, "waits": True}
    load = Load("proxy", seconds, prefix=f"run{next(RUNS)}", **more)
    load.hear("ready")
    load.hear("warm")
    begin = [sum(map(tree_cpu_s, pids)) for pids in (relays, nats)]
    load.hear("done")
    used = [sum(map(tree_cpu_s, pids)) - at for pids, at in zip((relays, nats), begin, strict=True)]
    load.tell({})
    end = load.hear("count")
    count = end["count"] or math.nan
    return (
        end["one_way_p50_us"],
        end["one_way_p99_us"],
        used[0] * 1e6 / count,
        used[1] * 1e6 / count,
    )


def idle_rows(servers: Any, nodes: Any, pairs: int, seconds: int) -> Iterable[Row]:
    """Yield what pairs cost that only have heartbeats: leases, lists, beacons, checks."""
    programs = {
        "relays": [program.pid for program in nodes.programs],
        "NATS servers": [process.pid for process in servers.processes],
    }
    shares: dict[str, dict[str, float]] = {}
    for where, ground in (("one node", 0), ("two nodes", 1)):
        ports = nodes.programs[0].airborne_port, nodes.programs[ground].ground_port
        name = f"idle{next(RUNS)}"
        ends = []
        for number in range(pairs):
            ends.append(dial(ports[0], f"UP1 aircraft={name}-{number}\n"))
            ends.append(dial(ports[1], f"UP1 aircraft={name}-{number} seat=command\n"))
        for _ in range(IDLE_SETTLE_S):
            beat(ends)
            time.sleep(1.0)
        begin = {what: sum(map(tree_cpu_s, pids)) for what, pids in programs.items()}
        for _ in range(seconds):
            beat(ends)
            time.sleep(1.0)
        shares[where] = {
            what: 100 * (sum(map(tree_cpu_s, pids)) - begin[what]) / seconds / pairs
            for what, pids in programs.items()
        }
        for end in ends:
            end.close()
    for what in programs:
        figure = "; ".join(f"{each[what]:.3f} % on {where}" for where, each in shares.items())
        yield Row(f"cluster, a pair with heartbeats, {pairs} pairs: CPU of the {what}", figure)


def killed_leader_rows(servers: Any, nodes: Any) -> Iterable[Row]:
    """Yield the longest gap of pairs when the NATS leader of the bucket dies, and a new lease."""
    gap_s, lease_s = run_in_reactor(kill_leader, servers, nodes, timeout_s=3 * DEADLINE_S)
    what = "cluster, kill -9 of the leader of the leases"
    yield limited(f"{what}: longest gap of pairs", "s", gap_s, GAP_S)
    yield limited(f"{what}: next new lease", "s", lease_s, NEW_LEASE_S)


async def kill_leader(servers: Any, nodes: Any) -> tuple[float, float]:
    """Return the longest gap of three pairs, and how long a new aircraft waits for its lease."""
    traffic = Traffic(nodes)
    for air, ground in ((0, 0), (0, 1), (1, 2)):
        traffic.pair(air, ground, f"gap-{air}{ground}")
    await all_relay(traffic.grounds)
    leader = servers.leader("KV_up-leases")
    reset_gaps(traffic.grounds)
    servers.kill(leader)
    began_s = time.monotonic()
    new = traffic.add_aircraft(0, "new")
    new.stays = True
    await until_later(lambda: new.is_open, DEADLINE_S)
    gap_s = longest_s(traffic.grounds)
    traffic.stop()
    servers.start(leader)
    return gap_s, new.opened_s - began_s


def killed_host_rows(instances: int) -> Iterable[Row]:
    """Yield when all instances of a killed host run elsewhere, and how many ran twice."""
    config = {"instances": 2 * instances, "start limit": 60}
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="upr-")))
        (folder / "nats").mkdir()
        servers = stack.enter_context(NatsServers(folder / "nats"))
        pool = RunnerPool(servers, folder, pool={"lease": LEASE_S}, **config)
        stack.callback(pool.close)
        host, *others = pool.runners
        host.start().logs("pool_ready")
        names = [f"glider-{number}" for number in range(instances)]
        until(lambda: host.ask(aircraft=names[0])["running"], "the first instance")
        for name in names:
            host.spawn(name)
        pool.repair()
        pool.kill_host(host)
        began_s = time.monotonic()
        for name in names:
            pool.running_at(others[0], name)
        took_s = time.monotonic() - began_s
        doubled = sum(len(doubles(lives(pool.history, name))) for name in names)
    what = f"pool, kill -9 of a host with {instances} instances"
    yield limited(f"{what}: all elsewhere", "s", took_s, ELSEWHERE_S)
    yield Row(f"{what}: two at a time", str(doubled), target="0", met=doubled == 0)


def rows(quick: bool = False) -> Iterable[Row]:
    # Each program of the hop has a core, and Go one thread for it.
    with patch.dict(os.environ, GOMAXPROCS="1"), cluster(hosts=0) as (_, servers, nodes):
        rounds, seconds = (QUICK_ROUNDS, QUICK_SECONDS) if quick else (ROUNDS, SECONDS)
        yield from hop_rows(servers, nodes, rounds, seconds)
        yield from idle_rows(servers, nodes, *((50, 2) if quick else (IDLE_PAIRS, IDLE_SECONDS)))
        yield from killed_leader_rows(servers, nodes)
    yield from killed_host_rows(QUICK_INSTANCES if quick else INSTANCES)
