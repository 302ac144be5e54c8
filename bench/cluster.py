"""Three proxies on three NATS servers: the hop between nodes, the loss of a leader or a host."""

import itertools
import math
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

from bench.relay import Load, tree_cpu_s
from bench.table import Row, compared
from bench.timing import Limit
from tests.proxy.cluster.nodes import Nodes
from tests.runner.pool.runner_pool import RunnerPool, doubles, lives
from tests.support.nats_servers import NatsServers
from tests.support.waiting import until

ROUNDS, QUICK_ROUNDS = 3, 1
SECONDS, QUICK_SECONDS = 3.0, 1.0
ADDED_P50_US, ADDED_P99_US = 800.0, 3000.0
CPU_RATIO, CPU_RATIO_WITH_NATS = 2.2, 3.7
BACK_S, NEW_LEASE_S = 3.0, 10.0
INSTANCES, QUICK_INSTANCES = 50, 5
"""Of the tests' application, which starts in a third of the time of Raspilot."""
LEASE_S = 10
"""The default of `runner.yml: pool: lease`."""
ELSEWHERE_S = 15.0
LIMITS = "limits:\n  connections per side: 6000\n  connections per address: 6000\n"
RECONNECT_S = 0.05
DEADLINE_S = 60.0
RATE_HZ = 10
"""Of each of the 100 pairs: proxies, NATS servers and the load share two cores."""
RUNS = itertools.count()
"""The names of a run are taken for 3 s after it."""


@contextmanager
def cluster() -> Iterator[tuple[Any, Any]]:
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        servers = stack.enter_context(NatsServers(folder))
        yield servers, stack.enter_context(Nodes(servers, folder, more=LIMITS))


def hop_rows(servers: Any, nodes: Any, rounds: int, seconds: float) -> Iterable[Row]:
    """Yield the hop between two nodes beside pairs of one node, the rounds interleaved."""
    relays = [program.pid for program in nodes.programs[:2]]
    nats = [process.pid for process in servers.processes]
    local, across = [], []
    for _ in range(rounds):
        local.append(measure(nodes, 0, 0, relays, nats, seconds))
        across.append(measure(nodes, 0, 1, relays, nats, seconds))
    added = [[far[i] - near[i] for near, far in zip(local, across, strict=True)] for i in (0, 1)]
    yield compared("cluster, added p50 of a round trip", "us", added[0], limit=Limit(ADDED_P50_US))
    yield compared("cluster, added p99 of a round trip", "us", added[1], limit=Limit(ADDED_P99_US))
    for what, parts, limit in (
        ("relays", slice(2, 3), CPU_RATIO),
        ("relays and NATS servers", slice(2, 4), CPU_RATIO_WITH_NATS),
    ):
        far, near = ([sum(run[parts]) for run in runs] for runs in (across, local))
        name = f"cluster, CPU of a round trip, {what}"
        yield compared(name, "us", far, "pairs of one node", near, Limit(limit))


def measure(
    nodes: Any, air: int, ground: int, relays: list[int], nats: list[int], seconds: float
) -> tuple[float, float, float, float]:
    """Return p50 and p99 of the round trip, CPU of relays and of NATS for one; microseconds."""
    programs = nodes.programs
    ports = {"echo": programs[air].airborne_port, "send": programs[ground].ground_port}
    load = Load("proxy", seconds, prefix=f"run{next(RUNS)}", rate_hz=RATE_HZ, **ports)
    load.hear("ready")
    load.hear("warm")
    begin = [sum(map(tree_cpu_s, pids)) for pids in (relays, nats)]
    load.hear("done")
    used = [sum(map(tree_cpu_s, pids)) - at for pids, at in zip((relays, nats), begin, strict=True)]
    load.tell({})
    end = load.hear("count")
    count = end["count"] or math.nan
    return end["p50_us"], end["p99_us"], used[0] * 1e6 / count, used[1] * 1e6 / count


def killed_leader_rows(servers: Any, nodes: Any) -> Iterable[Row]:
    """Yield the longest gap of pairs when the NATS leader of the bucket dies, and a new lease."""
    leader = servers.leader("KV_up-leases")
    gaps_s: list[float] = []
    ends = [nodes.pair(air, ground, f"gap-{air}{ground}") for air, ground in ((0, 1), (1, 2))]
    servers.kill(leader)
    began_s = last_s = time.monotonic()
    lease_s = math.nan
    for turn in itertools.count():
        for aircraft, ground, *_ in ends:
            mark = f"turn-{turn}"
            gaps_s.append(until_relayed(aircraft, ground, mark))
        now_s = time.monotonic()
        if math.isnan(lease_s) and now_s - last_s > RECONNECT_S:
            last_s = now_s
            with suppress(AssertionError):
                nodes.aircraft(0, "new")
                lease_s = time.monotonic() - began_s
        if not math.isnan(lease_s) or now_s - began_s > DEADLINE_S:
            break
    servers.start(leader)
    gap_s = max(gaps_s)
    yield Row("cluster, kill -9 of the leader of the leases: longest gap of pairs",
              f"{gap_s:.2f} s", target=f"<= {BACK_S:g} s", met=gap_s <= BACK_S)  # fmt: skip
    yield Row("cluster, kill -9 of the leader of the leases: next new lease",
              f"{lease_s:.1f} s", target=f"<= {NEW_LEASE_S:g} s",
              met=lease_s <= NEW_LEASE_S)  # fmt: skip


def until_relayed(aircraft: Any, ground: Any, mark: str) -> float:
    """Send a line until it arrives; return how long that took."""
    began_s = time.monotonic()
    ground.socket.settimeout(0.1)
    heard = b""
    while mark.encode() not in heard:
        aircraft.say(mark + "\n")
        with suppress(TimeoutError):
            heard += ground.socket.recv(65536)
    ground.socket.settimeout(DEADLINE_S)
    return time.monotonic() - began_s


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
    yield Row(f"{what}: all elsewhere", f"{took_s:.1f} s",
              target=f"<= {ELSEWHERE_S:g} s", met=took_s <= ELSEWHERE_S)  # fmt: skip
    yield Row(f"{what}: two at a time", str(doubled), target="0", met=doubled == 0)


def rows(quick: bool = False) -> Iterable[Row]:
    with cluster() as (servers, nodes):
        rounds, seconds = (QUICK_ROUNDS, QUICK_SECONDS) if quick else (ROUNDS, SECONDS)
        yield from hop_rows(servers, nodes, rounds, seconds)
        yield from killed_leader_rows(servers, nodes)
    yield from killed_host_rows(QUICK_INSTANCES if quick else INSTANCES)
