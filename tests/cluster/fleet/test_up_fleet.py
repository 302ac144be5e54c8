"""`up-fleet` with real proxies and runners on one NATS server, for two tenants."""

import json

import pytest

from tests.cluster.fleet.up_fleet import UpFleet
from tests.proxy.cluster.nodes import Nodes, alive, refusal
from tests.runner.pool.runner_pool import RunnerPool
from tests.runner.runners import is_alive, same_instance
from tests.support.nats_servers import NatsServers
from tests.support.scrape import probe
from tests.support.waiting import until
from up_cluster.fleet.main import main

TENANT = "club"
ACCOUNTS = """
accounts {
  A { jetstream: enabled, users: [ { user: a, password: one } ] }
  B { jetstream: enabled, users: [ { user: b, password: two } ] }
  UNUSED { jetstream: enabled, users: [ { user: c, password: three } ] }
  PLAIN { users: [ { user: d, password: four } ] }
}
"""


def credentials(folder, text):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "nats.txt").write_text(text)
    (folder / "nats.txt").chmod(0o600)
    return str(folder / "nats.txt")


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with NatsServers(tmp_path_factory.mktemp("nats"), 1, ACCOUNTS) as running:
        yield running


@pytest.fixture(scope="module")
def a(tmp_path_factory):
    return credentials(tmp_path_factory.mktemp("a"), "a:one")


@pytest.fixture
def fleet(server, tmp_path, a):
    return UpFleet(tmp_path / "fleet", server.urls, f"tenant: {TENANT}\ncredentials: {a}\n")


def test_runners_are_listed_drained_and_their_instances_stopped(server, short_path, fleet, a):
    with RunnerPool(server, short_path, 2, pool={"credentials": a, "tenant": TENANT}) as pool:
        first = pool.runners[0].ask(aircraft="glider-1", labels=["any"])
        host = pool.host_of(first)
        other = pool.others(host)[0]
        row = fleet.member("runner", first["host"])
        assert [each["pid"] for each in row["aircraft"]] == [first["pid"]]
        assert row["aircraft"][0]["rss_bytes"] > 1e6 and row["aircraft"][0]["cpu_s"] > 0
        place = fleet.ask("where", "glider-1")["places"][0]
        assert (place["host"], place["ports"]) == (first["host"], first["ports"])

        assert pool.health(host) == (200, "ready")
        assert fleet.ask("drain", row["id"])["left"] == ["glider-1"]
        assert pool.health(host) == (503, "draining")
        assert not is_alive(first["pid"]) and host.instances() == []
        second = pool.running_at(other, "glider-1")
        assert second["host"] != first["host"]
        # Nothing starts here again; requests are still answered.
        assert same_instance(host.ask(aircraft="glider-1"), second)
        refused = host.ask(aircraft="glider-2", labels=[pool.label_of(host)])
        assert (refused["code"], host.instances()) == ("no_runner", [])

        assert fleet.ask("kick", "glider-1", "--instance")["done"] == "stopped"
        until(lambda: not other.status("glider-1")["running"], "its end")
        assert fleet.refused("kick", "glider-1", "--instance") == (1, ["unknown_aircraft"])

        # One that no host can start stays wanted, until it is given up.
        alone = other.ask(aircraft="alone", labels=[pool.label_of(other)])
        pool.kill_host(pool.host_of(alone))
        until(lambda: pool.figure(host, "orphans") == 1, "the orphan")
        (place,) = fleet.ask("where", "alone")["places"]
        assert (place["kind"], place["state"]) == ("runner", "wanted")
        assert fleet.ask("list")["orphans"] == ["alone"]
        assert fleet.ask("kick", "alone", "--instance")["done"] == "not_wanted"
        until(lambda: pool.figure(host, "orphans") == 0, "it is forgotten")


def test_proxies_are_drained_and_aircraft_disconnected(server, tmp_path, fleet, a):
    more = f"  tenant: {TENANT}\n  replicas: 1\n  credentials: {a}\n"
    with Nodes(server, tmp_path, 2, more) as nodes:
        aircraft, ground, _air_token, _ = nodes.pair(0, 1, "glider-1")
        with alive(aircraft, ground):
            hello = "UP1 aircraft=glider-1\n"
            assert refusal(nodes.programs[1].airborne_port, hello) == "taken"
            place = fleet.ask("where", "glider-1")["places"][0]
            assert (place["kind"], place["state"]) == ("proxy", "online")
            assert fleet.ask("kick", "glider-1")["id"] == place["id"]
            aircraft.file.read()
        # Its name is free for every aircraft, without the token.
        again, _ = nodes.aircraft(0, "glider-1")
        with alive(again):
            port = nodes.programs[0].metrics_port
            assert probe(port, "ready") == (200, "ready")
            assert fleet.ask("drain", place["id"])["left"] == ["glider-1"]
            again.file.read()
            assert [probe(port, each) for each in ("live", "ready")] == [
                (200, "live"),
                (503, "draining"),
            ]
            logged = {"draining", "aircraft_left"}
            until(lambda: logged <= set(nodes.programs[0].codes()), "the log")
            # It is nowhere, and no silent member has it.
            assert fleet.refused("where", "glider-1") == (1, ["unknown_aircraft"])
            assert fleet.ask("list")["lost"] == []
        new, _ = nodes.aircraft(1, "glider-1")
        with new:
            assert nodes.programs[0].process.poll() is None
            with pytest.raises(ConnectionRefusedError):
                nodes.aircraft(0, "another")
            drained = next(r for r in fleet.ask("list")["members"] if r["id"] == place["id"])
            assert (drained["is_draining"], drained["aircraft"]) == (True, [])
            # A node that has ended left its aircraft free.
            assert nodes.programs[1].end() == 0
            assert fleet.refused("where", "glider-1") == (1, ["unknown_aircraft"])
            assert fleet.ask("list")["lost"] == []


def test_the_list_after_the_death_of_a_nats_server(tmp_path):
    """NATS may choose it to send the entries, for up to a minute."""
    (tmp_path / "nats").mkdir()
    with NatsServers(tmp_path / "nats") as servers, Nodes(servers, tmp_path, 1) as nodes:
        fleet = UpFleet(tmp_path / "fleet", servers.urls)
        aircraft, _ = nodes.aircraft(0, "glider-1")
        with alive(aircraft):
            leader = servers.leader("KV_up-leases")
            # Proxy and up-fleet are connected to the first.
            servers.kill(next(each for each in (1, 2) if each != leader))
            for _ in range(3):
                (member,) = fleet.ask("list")["members"]
                assert [row["aircraft"] for row in member["aircraft"]] == ["glider-1"]


def test_another_tenant_sees_and_changes_nothing(server, tmp_path, fleet, a):
    more = f"  tenant: {TENANT}\n  replicas: 1\n  credentials: {a}\n"
    b = credentials(tmp_path / "b", "b:two")
    of_b = UpFleet(tmp_path / "fleet-b", server.urls, f"tenant: {TENANT}\ncredentials: {b}\n")
    more_b = f"  tenant: {TENANT}\n  replicas: 1\n  credentials: {b}\n"
    (tmp_path / "na").mkdir()
    (tmp_path / "nb").mkdir()
    with (
        Nodes(server, tmp_path / "na", 1, more) as nodes,
        Nodes(server, tmp_path / "nb", 1, more_b),
    ):
        aircraft, _ = nodes.aircraft(0, "glider-1")
        with alive(aircraft):
            id_a = fleet.ask("where", "glider-1")["places"][0]["id"]
            listed = of_b.ask("list")
            assert id_a not in {each["id"] for each in listed["members"]}
            assert (listed["lost"], listed["orphans"]) == ([], [])
            assert of_b.refused("kick", "glider-1") == (1, ["unknown_aircraft"])
            assert of_b.refused("drain", id_a) == (1, ["no_answer"])
            place = fleet.ask("where", "glider-1")["places"][0]
            assert (place["id"], place["state"]) == (id_a, "online")


@pytest.mark.parametrize(("login", "code"), [("c:three", "no_bucket"), ("d:four", "no_jetstream")])
def test_an_account_that_no_cluster_uses(server, tmp_path, login, code):
    text = f"credentials: {credentials(tmp_path / 'user', login)}\n"
    assert UpFleet(tmp_path / "fleet", server.urls, text).refused("list") == (1, [code])


@pytest.mark.parametrize("login", ["a:two", ""])
def test_a_refused_login_is_told(server, tmp_path, login):
    text = f"credentials: {credentials(tmp_path / 'user', login)}\n" if login else ""
    assert UpFleet(tmp_path / "fleet", server.urls, text).refused("list") == (1, ["nats_refused"])


def test_a_server_without_jetstream(tmp_path):
    with NatsServers(tmp_path, 1, jetstream=False) as server:
        fleet = UpFleet(tmp_path / "fleet", server.urls)
        assert fleet.refused("list") == (1, ["no_jetstream"])


@pytest.mark.parametrize("words", ["lost", "drain glider-1", "where ../x", "kick", "list --wait 0"])
def test_wrong_use(words, capsys):
    with pytest.raises(SystemExit) as ended:
        main(words.split())
    assert (ended.value.code, capsys.readouterr().out) == (2, "")


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", "no_servers"),
        ("servers: nats://a:0\n", "inconsistent"),
        ("servers: a\ntenant: a.b\n", "inconsistent"),
        ("servers: a\ncredentials: none.txt\n", "no_file"),
        ("servers: a\ntls: none\n", "tls_no_file"),
    ],
)
def test_a_configuration_that_cannot_work(tmp_path, text, code, capsys, monkeypatch):
    monkeypatch.setenv("UP_LOG_FORMAT", "json")
    (tmp_path / "fleet.yml").write_text(text)
    assert main(["--config", str(tmp_path), "list"]) == 2
    lines = [json.loads(line) for line in capsys.readouterr().err.splitlines()]
    # The first log that begins in a process shows what other tests logged before, then its own.
    assert lines[-1]["level"] == "error" and lines[-1]["fields"]["code"] == code
