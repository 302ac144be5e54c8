"""Random faults, and the history of leases or of relays in each: a separate process.

Arguments: `leases` or `relays`, the first seed, the number of seeds. Prints a JSON object for each.
"""

import itertools
import json
import random
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from dataclasses import asdict
from pathlib import Path
from typing import Any

from bench.table import Row
from tests.cluster.lease_history import run, violations
from tests.proxy.cluster.nodes import Nodes
from tests.proxy.cluster.traffic import Traffic
from tests.support.hosts import Hosts
from tests.support.nats_servers import NatsServers
from tests.support.reactor import reactor, run_in_reactor, sleep, until
from up_cluster.key_value import KeyValueBucket

FAULTS = 3
LENGTHS_S = 0.3, 1.0, 2.0, 4.0
AFTER_S = 3.0
PERIOD_S, STEP_S = 0.2, 0.2
LIMIT_S = 120.0
TOGETHER_S = 3.0
"""Two aircraft of a name may be connected this long: a former home closes when it learns of it."""
WORKERS = 4

Fault = tuple[str, Callable[[], object], Callable[[], object]]
"""Its name, what breaks, and what repairs it."""
HUNG_RELAY = "SIGSTOP of a relay"
"""It relays what clients sent during its pause when it continues."""


def server_faults(network: Any, servers: Any, draw: random.Random) -> list[Fault]:
    """Return one fault of each kind, at hosts that the seed selects."""
    host, other = draw.sample(range(3), 2)
    return [
        ("SIGSTOP of NATS", lambda: servers.pause(host), lambda: servers.resume(host)),
        ("SIGKILL of NATS", lambda: servers.kill(host), lambda: servers.start(host)),
        ("host without network", lambda: network.isolate(host), network.heal),
        ("cut", lambda: network.cut([(host, other), (other, host)]), network.heal),
        ("cut in one direction", lambda: network.cut([(host, other)]), network.heal),
    ]


def relay_faults(nodes: Any, draw: random.Random) -> list[Fault]:
    node = draw.randrange(3)

    def send(number: int) -> None:
        nodes.programs[node].process.send_signal(number)

    return [
        (HUNG_RELAY, lambda: send(signal.SIGSTOP), lambda: send(signal.SIGCONT)),
        ("SIGKILL of a relay", lambda: send(signal.SIGKILL), lambda: nodes.start(node)),
        ("SIGTERM of a relay", lambda: send(signal.SIGTERM), lambda: nodes.start(node)),
    ]


def schedule(faults: Iterable[Fault], draw: random.Random) -> list[tuple[float, Any]]:
    """Return when each fault comes and when it is repaired, one after the other."""
    found, at_s = [], 0.0
    for _, breaks, repairs in faults:
        at_s += draw.uniform(0.1, 1.0)
        found.append((at_s, breaks))
        at_s += draw.choice(LENGTHS_S)
        found.append((at_s, repairs))
    return found


def search_leases(network: Any, servers: Any, seed: int) -> dict[str, Any]:
    """Return the violations in the history of one lease."""
    draw = random.Random(seed)
    faults = draw.sample(server_faults(network, servers, draw), FAULTS)
    plan = schedule(faults, draw)
    end_s = plan[-1][0] + AFTER_S
    arguments = servers, f"seed-{seed}", seed, end_s, KeyValueBucket, plan
    history = run_in_reactor(run, *arguments, timeout_s=LIMIT_S)
    found = [what for what, *_ in violations(history)]
    return {"count": len(history), "violations": found, "faults": [name for name, *_ in faults]}


def search_relays(network: Any, servers: Any, nodes: Any, seed: int) -> dict[str, Any]:
    """Return the violations between aircraft and grounds."""
    draw, traffic = random.Random(seed), Traffic(nodes, PERIOD_S)
    kinds = server_faults(network, servers, draw), relay_faults(nodes, draw)
    faults = [draw.sample(kind, 2) for kind in kinds]
    plan = [each for kind in faults for each in schedule(kind, draw)]
    together_s = run_in_reactor(disturb, traffic, draw, plan, timeout_s=2 * LIMIT_S)
    counts = {**asdict(traffic.faults), "lost": len(traffic.unexecuted())}
    found = [name for name, count in counts.items() if count]
    found += ["two aircraft"] * (together_s > TOGETHER_S)
    oldest_s = max(each.oldest_s for each in traffic.grounds)
    answers = sum(len(each.acknowledged) for each in traffic.grounds)
    names = [name for kind in faults for name, *_ in kind]
    return {"count": answers, "violations": found, "oldest_s": oldest_s, "faults": names}


async def disturb(traffic: Traffic, draw: random.Random, plan: list[tuple[float, Any]]) -> float:
    """Relay, change control and break things; return how long two aircraft had one name."""
    begin = f"{draw.random():.6f}"
    for air, ground in itertools.product(range(3), repeat=2):
        traffic.pair(air, ground, f"{begin}-{air}{ground}")
        traffic.add_ground((ground + 1) % 3, f"{begin}-{air}{ground}")
    await until(lambda: all_answered(traffic), LIMIT_S)
    firsts = list(traffic.aircraft)
    seconds = [traffic.add_aircraft(draw.randrange(3), each.name) for each in firsts[::4]]
    for each in seconds:
        each.stays = True
    timers = [reactor.callLater(at_s, what) for at_s, what in plan]
    together_s = dict.fromkeys(seconds, 0.0)
    while any(timer.active() for timer in timers):
        draw.choice(traffic.grounds).release()
        draw.choice(traffic.grounds).request()
        await sleep(STEP_S)
        for first, second in zip(firsts[::4], seconds, strict=True):
            together_s[second] += STEP_S * (first.is_open and second.is_open)
    for each in traffic.grounds:
        each.frames.reset()
        each.answers.reset()
    await until(lambda: all_answered(traffic), LIMIT_S, "data after the repair")
    traffic.stop()
    await sleep(2 * STEP_S)
    return max(together_s.values())


def all_answered(traffic: Traffic) -> bool:
    """Return whether every ground gets frames, and one of each aircraft answers; others request."""
    answered = {each.name for each in traffic.grounds if each.answers.count}
    for each in traffic.grounds:
        if each.name not in answered and not each.has_control:
            each.request()
    return len(answered) == len({each.name for each in traffic.aircraft}) and all(
        each.frames.count for each in traffic.grounds
    )


def main(what: str, first: int, count: int) -> None:
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        network = stack.enter_context(Hosts())
        servers = stack.enter_context(NatsServers(folder, network=network))
        parts: tuple[Any, ...] = (network, servers)
        if what == "relays":
            parts = (*parts, stack.enter_context(Nodes(servers, folder)))
        search = {"leases": search_leases, "relays": search_relays}[what]
        for seed in range(first, first + count):
            print(json.dumps({"seed": seed, **search(*parts, seed)}), flush=True)


def search_rows(what: str, seeds: int) -> Iterable[Row]:
    """Yield the violations that some processes find, each with its share of the seeds."""
    share = -(-seeds // WORKERS)
    command = [sys.executable, "-m", "bench.cluster_search", what]
    running = [
        subprocess.Popen(
            [*command, str(first), str(min(share, seeds - first))], stdout=subprocess.PIPE
        )
        for first in range(0, seeds, share)
    ]
    found = [json.loads(line) for each in running for line in each.communicate()[0].splitlines()]
    if len(found) < seeds:
        raise RuntimeError(f"only {len(found)} of {seeds} searches ended")
    counts = Counter(name for each in found for name in each["violations"])
    unit = {"leases": "leases", "relays": "answers"}[what]
    total = sum(each["count"] for each in found)
    text = ", ".join(f"{count} {name}" for name, count in counts.items()) or "0"
    name = f"cluster, violations in {seeds} searches for faults of {what} ({total} {unit})"
    yield Row(name, text, target="0", met=not counts)
    if what == "relays":
        ages = [each["oldest_s"] for each in found if HUNG_RELAY not in each["faults"]]
        yield Row(f"{name}: oldest frame, no relay hung", f"{max(ages, default=0.0):.2f} s")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
