"""The host of the leader of the leases, home of aircraft, loses the other hosts for 10 s."""

import time
from functools import partial

import pytest

from tests.proxy.cluster.nodes import Nodes
from tests.proxy.cluster.traffic import Faults, Traffic
from tests.support.hosts import Hosts
from tests.support.nats_servers import NatsServers
from tests.support.reactor import run_in_reactor, sleep, until

PARTITION_S = 10.0
KEPT_S = 9.5
"""How long a lease certainly lasts that is renewed every 5 s for 15 s."""
LIMIT_S = 90.0


@pytest.fixture
def network():
    with Hosts() as hosts:
        yield hosts


def test_a_partition(network, tmp_path):
    (tmp_path / "nats").mkdir()
    with (
        NatsServers(tmp_path / "nats", network=network) as servers,
        Nodes(servers, tmp_path) as nodes,
    ):
        traffic = Traffic(nodes)
        run_in_reactor(partition, network, traffic, servers.leader("KV_up-leases"), timeout_s=600)


async def partition(network, traffic, cut):
    one, other = (number for number in range(3) if number != cut)
    away, from_away = traffic.pair(cut, one, "away")
    local, from_local = traffic.pair(cut, cut, "local")
    _, from_beside = traffic.pair(one, other, "beside")
    await until(lambda: all(each.acknowledged for each in traffic.grounds), LIMIT_S)

    network.isolate(cut)
    began_s = time.monotonic()
    second = traffic.add_aircraft(other, "away")
    refused, new = traffic.add_aircraft(cut, "refused"), traffic.add_aircraft(one, "new")
    refused.stays = second.stays = new.stays = True
    await until(lambda: not from_away.is_aircraft_online, LIMIT_S)
    await until(lambda: second.refusals["taken"] or time.monotonic() - began_s > KEPT_S, LIMIT_S)
    assert not second.connects
    second.stop()
    await until(lambda: new.is_open, LIMIT_S)
    await until(lambda: refused.refusals, LIMIT_S)
    await sleep(max(0.0, began_s + PARTITION_S - time.monotonic()))
    assert refused.refusals.keys() == {"cluster"}
    assert not refused.connects
    for name, ground in (("local", from_local), ("beside", from_beside)):
        count = len(ground.acknowledged)
        is_answered = partial(lambda each, count: len(each.acknowledged) > count, ground, count)
        await until(is_answered, LIMIT_S, name)

    network.heal()
    from_away.frames.reset()
    count = len(from_away.acknowledged)
    await until(lambda: len(from_away.acknowledged) > count and from_away.frames.count, LIMIT_S)
    await until(lambda: refused.is_open, LIMIT_S)
    assert from_away.is_aircraft_online
    assert [away.connects, local.connects] == [1, 1]
    # A busy machine delays the local pair as much.
    assert from_away.oldest_s < 2.0 + from_local.oldest_s
    assert traffic.faults == Faults()
    assert traffic.unexecuted() == set()
    traffic.stop()
    await sleep(0.1)
