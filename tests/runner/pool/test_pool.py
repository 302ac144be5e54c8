"""Three runners and three NATS servers, as real processes."""

import os
import random
import signal
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from tests.cluster.connected import connected
from tests.cluster.fleet.up_fleet import UpFleet
from tests.runner.pool.runner_pool import RunnerPool, doubles, lives
from tests.runner.runners import is_alive, same_instance, wait_until
from tests.support.nats_servers import NatsServers
from tests.support.reactor import run_in_reactor, sleep
from tests.support.scrape import scrape
from tests.support.waiting import until
from up.system.deadline_watch import read_deadline
from up_cluster.key_value import KeyValueBucket
from up_cluster.membership import LEASES, ask
from up_runner.pool.state_files import FLIGHTS
from up_runner.request import Request, encode_request

SEED = 18


@pytest.fixture(scope="module")
def servers(tmp_path_factory):
    with NatsServers(tmp_path_factory.mktemp("nats")) as running:
        yield running


@pytest.fixture(scope="module")
def shared_pool(servers):
    with (
        tempfile.TemporaryDirectory(prefix="upr-") as folder,
        RunnerPool(servers, Path(folder)) as running,
    ):
        yield running


@pytest.fixture
def pool(shared_pool):
    shared_pool.repair()
    return shared_pool


def test_any_runner_answers_for_the_one_host_of_an_aircraft(pool):
    def started():
        """Return the answer, unless busy servers elect a leader, or a busy runner is not heard."""
        answer = pool.runners[0].ask(aircraft="a.b-1", labels=["host1"])
        return None if answer.get("code") in ("cluster", "no_runner") else answer

    first = until(started, "the first instance")
    assert (first["running"], first.get("code"), first.get("host")) == (True, None, "127.0.0.2")
    assert first["spawned"]
    assert pool.runners[1].instances() == [first["pid"]]
    for runner in pool.runners:
        assert same_instance(runner.ask(aircraft="a.b-1"), first)
        assert runner.status("a.b-1")["pid"] == first["pid"]
    refused = pool.runners[0].ask(aircraft="b", labels=["host1", "host2"])
    assert (refused["running"], refused["code"]) == (False, "no_runner")
    # Its end is the end of the aircraft everywhere: nothing starts it again.
    os.kill(first["pid"], signal.SIGTERM)
    assert run_in_reactor(is_wanted_after_its_end, pool, "a=b-1") is False
    assert pool.runners[2].ask(aircraft="a.b-1", labels=["host2"])["host"] == "127.0.0.3"


async def is_wanted_after_its_end(pool, word):
    client = await connected(pool.servers)
    bucket = KeyValueBucket(client, LEASES)
    while not (await bucket.get(f"instance.{pool.tenant}.{word}")).is_deleted:
        await sleep(0.05)
    entry = await bucket.get(f"wanted.{pool.tenant}.{word}")
    await client.stop()
    return not entry.is_deleted


def test_a_start_is_refused_where_another_runner_has_the_lease(pool):
    first = pool.runners[0].ask(aircraft="leased", labels=["host0"])
    answer = run_in_reactor(start_at, pool, pool.runners[1], "leased")
    assert (answer["code"], answer["pid"]) == ("elsewhere", None)
    assert pool.runners[1].status("leased")["pid"] == first["pid"]
    assert len(lives(pool.history, "leased")) == 1


async def start_at(pool, runner, aircraft):
    """Send a runner what another one does whose view of the pool is late."""
    client = await connected(pool.servers)
    message = {"action": "start", **encode_request(Request(aircraft))}
    member = runner.logs("pool_ready")["node"]
    answer = await ask(client, f"up.{pool.tenant}.member.{member}", message, 20.0)
    await client.stop()
    return answer


def test_a_dead_host_leaves_its_instance_and_its_learned_files_to_another(pool):
    first = pool.runners[0].spawn("dead")
    host = pool.host_of(first)
    (host.run_folder / "dead" / "config" / "mission.json").write_text('{"plan": 1}')
    host.logs("state_saved", files=1)
    other = pool.others(host)[0]
    pool.kill_host(host)
    second = pool.running_at(other, "dead")
    assert second["pid"] != first["pid"] and second["host"] != first["host"]
    moved = pool.host_of(second).run_folder / "dead" / "config" / "mission.json"
    assert moved.read_text() == '{"plan": 1}'


def test_an_instance_ends_before_another_host_starts_it_while_its_runner_is_stopped(pool):
    first = pool.runners[0].spawn("stopped")
    host = pool.host_of(first)
    host.process.send_signal(signal.SIGSTOP)
    second = pool.running_at(pool.others(host)[0], "stopped")
    assert not is_alive(first["pid"]) and second["pid"] != first["pid"]
    host.process.send_signal(signal.SIGCONT)
    # The first one neither continues nor starts again.
    host.logs("ended", cause="lease_lost", aircraft="stopped")
    assert pool.running_at(host, "stopped")["pid"] == second["pid"]
    spans = lives(pool.history, "stopped")
    assert [span[2] for span in spans] == [str(first["pid"]), str(second["pid"])]
    assert doubles(spans) == []


def test_a_restarted_runner_keeps_its_instances_and_a_stopped_one_leaves_them(servers, short_path):
    # A long lease: neither it nor the deadline may end while the runner starts.
    with RunnerPool(servers, short_path, 2, pool={"lease": 30}) as pool:
        first = pool.runners[0].spawn("kept")
        host, other = pool.host_of(first), pool.others(pool.host_of(first))[0]
        deadline = host.run_folder / "kept" / "deadline"
        # The black box still writes it: another runner may not move it.
        flight = host.run_folder / "kept" / FLIGHTS / "0001.mcap"
        flight.parent.mkdir(parents=True)
        flight.write_bytes(b"open")
        host.kill()
        before_s = read_deadline(deadline)
        host.start(under_systemd=False)
        host.logs("taken_over")
        wait_until(lambda: read_deadline(deadline) > before_s, "a renewal")
        assert flight.read_bytes() == b"open"
        assert same_instance(pool.running_at(other, "kept"), first)
        assert host.terminate() == 0
        second = pool.running_at(other, "kept")
        assert second["host"] != first["host"] and not is_alive(first["pid"])


def test_the_history_of_an_aircraft_has_one_instance_at_a_time(pool):
    pool.runners[0].spawn("history")
    for fault in random.Random(SEED).sample(["stop", "kill", "hang"], 3):
        running = [each for each in pool.runners if each.process]
        answers = [each.status("history") for each in running]
        host = pool.host_of(next(each for each in answers if each["running"]))
        match fault:
            case "stop":
                # The whole machine: runner and instance.
                stopped = [host.process.pid, *host.instances()]
                for pid in stopped:
                    os.kill(pid, signal.SIGSTOP)
                wait_until(lambda h=host: moved(pool, h), "it moves")
                # The runner last: it ends the instance as soon as it continues.
                for pid in reversed(stopped):
                    os.kill(pid, signal.SIGCONT)
            case "hang":
                host.process.send_signal(signal.SIGSTOP)
                wait_until(lambda h=host: moved(pool, h), "it moves")
                host.process.send_signal(signal.SIGCONT)
            case "kill":
                pool.kill_host(host)
                wait_until(lambda h=host: moved(pool, h), "it moves")
                host.start()
                host.logs("pool_ready")
    spans = lives(pool.history, "history")
    assert len(spans) >= 4 and doubles(spans) == []


def moved(pool, host):
    answers = (each.status("history") for each in pool.others(host))
    return any(each["running"] and pool.host_of(each) is not host for each in answers)


def test_the_checker_of_histories():
    assert doubles([(1.0, 2.0, "a"), (2.5, 3.0, "b")]) == []
    assert doubles([(1.0, 9.0, "a"), (2.5, 3.0, "b"), (8.0, 8.5, "c")]) == [("a", "b"), ("a", "c")]


def test_a_runner_without_nats_kills_an_instance_that_knows_no_deadline(servers, short_path):
    ignorant = {"behaviour.yml": {"history": str(short_path / "history")}}
    with RunnerPool(servers, short_path, 2, alone=(1,), files=ignorant) as pool:
        first = pool.runners[0].ask(aircraft="cut-off", labels=["host1"])
        assert first["host"] == "127.0.0.2"
        with servers.paused(1):
            pool.runners[1].logs("pool_lost")
            pool.runners[1].logs("ended", cause="lease_lost")
            assert not is_alive(first["pid"])
            answer = pool.runners[1].ask(aircraft="cut-off")
            assert (answer["running"], answer["code"]) == (False, "cluster")
            # The other one may have been connected to the server that does not answer.
            wanted = [(200, "ready"), (503, "cluster")]
            until(lambda: [pool.health(each) for each in pool.runners] == wanted, "their health")
        again = pool.running_at(pool.runners[0], "cut-off")
        assert again["host"] == "127.0.0.2", "only this one has the label"
        assert doubles(lives(pool.history, "cut-off")) == []


def test_requests_at_the_same_time_do_not_exceed_the_quota(servers, short_path):
    names = [f"at-once-{number}" for number in range(6)]
    with (
        RunnerPool(servers, short_path, 1, pool={"quota_instances": 2, "lease": 30}) as pool,
        ThreadPoolExecutor(len(names)) as at_once,
    ):
        (runner,) = pool.runners
        answers = list(at_once.map(lambda name: runner.ask(aircraft=name), names))
    assert Counter(answer.get("code") for answer in answers) == {None: 2, "quota": 4}


def test_a_tenant_over_its_quota_is_refused_by_every_runner_and_another_is_not(servers, short_path):
    quota = {"quota_instances": 2}
    with (
        RunnerPool(servers, short_path / "full", 2, pool=quota) as pool,
        RunnerPool(servers, short_path / "other", 1, pool=quota) as other,
    ):
        first, second = pool.runners
        assert first.ask(aircraft="a", labels=["host0"])["spawned"]
        running = second.ask(aircraft="b", labels=["host1"])
        for runner in pool.runners:
            refused = runner.ask(aircraft="c")
            assert (refused["running"], refused["code"]) == (False, "quota")
            assert runner.ask(aircraft="b")["pid"] == running["pid"]
        assert other.runners[0].spawn("c")["spawned"]
        usage = scrape(first.logs("metrics_open")["port"])
        assert usage["up_runner_pool_tenant_usage", "instances"] == 2
        assert usage["up_runner_pool_tenant_quota", "instances"] == 2
        fleet = UpFleet(short_path / "fleet", servers.urls, f"tenant: {pool.tenant}\n")
        tenant = fleet.ask("usage")["tenant"]
        assert (tenant["usage"], tenant["quota"]) == ({"instances": 2}, {"instances": 2})
        # One that ends leaves its place to another.
        assert fleet.ask("kick", "a", "--instance")["done"] == "stopped"
        wait_until(lambda: first.ask(aircraft="c")["running"], "a free place")


def test_an_instance_sleeps_without_its_phone_and_the_next_request_wakes_it(servers, short_path):
    settings = {"exit on connection lost": False}
    with RunnerPool(servers, short_path, 2, pool={"sleep_after_s": 0.5}, **settings) as pool:
        for runner in pool.runners:
            runner.write("profiles/easy/telemetry.yml", {"rate": 5})
        host, other = pool.runners
        first = other.ask(aircraft="sleeper", profile="easy", labels=["host0"])
        talk = host.talk(first["ports"]["general"])
        # Armed, without its phone for longer than the time.
        for order in ("armed 1", "phone 0", "nap 1.5"):
            talk.order(order)
        assert other.status("sleeper")["pid"] == first["pid"]
        (host.run_folder / "sleeper" / "config" / "mission.json").write_text('{"plan": 1}')
        talk.order("armed 0")
        host.logs("ended", cause="asleep", aircraft="sleeper")
        wait_until(lambda: other.status("sleeper")["code"] == "asleep", "it sleeps")
        assert not is_alive(first["pid"])
        assert pool.figure(other, "orphans") == 0 and pool.figure(other, "asleep") == 1
        fleet = UpFleet(short_path / "fleet", servers.urls, f"tenant: {pool.tenant}\n")
        assert fleet.ask("list")["asleep"] == ["sleeper"]
        (place,) = fleet.ask("where", "sleeper")["places"]
        assert (place["kind"], place["state"], place["id"]) == ("runner", "asleep", "")
        # At another host, by a request that names nothing but the aircraft.
        assert host.terminate() == 0
        second = other.ask(aircraft="sleeper", labels=["host1"])
        assert (second["spawned"], second["host"]) == (True, "127.0.0.2")
        config = other.run_folder / "sleeper" / "config"
        assert (config / "telemetry.yml").read_text() == "rate: 5\n"
        assert (config / "mission.json").read_text() == '{"plan": 1}'
        wait_until(lambda: pool.figure(other, "asleep") == 0, "it is awake")
