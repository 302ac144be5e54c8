"""Two runners, each on its host with a NATS server: the host of an instance loses the others.

With the lease of the default: a shorter one does not outlast the election of a leader in NATS.
"""

import pytest

from tests.runner.pool.runner_pool import doubles, lives
from tests.runner.runners import RunnerProcess, wait_until
from tests.support.hosts import Hosts
from tests.support.nats_servers import NatsServers

COUNT = 2


@pytest.fixture
def network():
    with Hosts() as hosts:
        yield hosts


@pytest.fixture
def servers(network, tmp_path):
    (tmp_path / "nats").mkdir()
    with NatsServers(tmp_path / "nats", network=network) as running:
        yield running


@pytest.fixture
def runners(network, servers, short_path):
    """Runners on two of three hosts."""
    made = [runner_on(number, network, servers, short_path) for number in range(COUNT)]
    yield made
    for each in made:
        each.clean()


def runner_on(number, network, servers, folder):
    urls = servers.urls.split(",")
    pool = {
        "servers": ",".join([*urls[number:], *urls[:number]]),
        "address": network.addresses[number],
        "replicas": len(urls),
    }
    runner = RunnerProcess(folder / f"host{number}", pool=pool, i_accept_plain=True)
    behaviour = {"keeps deadline": True, "history": str(folder / "history")}
    runner.write("blackbox/behaviour.yml", behaviour)
    runner.prefix, runner.host = network.prefixes[number], network.addresses[number]
    return runner


def test_a_partition(network, servers, runners, short_path):
    # The host with the leader of the leases, if it has a runner: the others must elect one.
    runners[0].start().logs("pool_ready")
    home = servers.leader("KV_up-leases") % COUNT
    if home != 0:
        runners[0].terminate()
        runners[home].start().logs("pool_ready")
    near, far = runners[home], runners[1 - home]
    spawned = wait_until(lambda: answer_of(near, "cut"), "an instance")
    far.start().logs("pool_ready")

    network.isolate(home)
    moved = wait_until(lambda: answer_of(far, "cut", action="status"), "it moves")
    assert moved["host"] == far.host
    assert spawned["pid"] not in near.instances()
    refused = near.ask(aircraft="new")
    assert (refused["running"], refused["code"]) == (False, "cluster")

    network.heal()
    healed = wait_until(lambda: answer_of(near, "cut", action="status"), "it knows the other")
    assert (healed["host"], healed["pid"]) == (moved["host"], moved["pid"])
    spans = lives(short_path / "history", "cut")
    assert [span[2] for span in spans] == [str(spawned["pid"]), str(moved["pid"])]
    assert doubles(spans) == []


def answer_of(runner, aircraft, **request):
    answer = runner.ask(aircraft=aircraft, **request)
    return answer if answer["running"] else None
