"""The quota of one tenant over two proxies, beside another tenant on the same NATS server."""

import pytest

from tests.cluster.fleet.up_fleet import UpFleet
from tests.proxy.cluster.nodes import Nodes, alive, refusal, relayed
from tests.support.nats_servers import NatsServers
from tests.support.scrape import scrape
from tests.support.waiting import until
from up_cluster.fleet.tables import usage_table


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with NatsServers(tmp_path_factory.mktemp("nats"), 1) as running:
        yield running


def usage(nodes, node, kind):
    return scrape(nodes.programs[node].metrics_port)["up_proxy_tenant_usage", kind]


def tenant(server, folder, name, count, quota):
    folder.mkdir()
    return Nodes(server, folder, count, f"  replicas: 1\n  tenant: {name}\nquota: {quota}\n")


def test_a_tenant_over_its_quota_is_refused_at_every_node_and_another_is_not(server, tmp_path):
    with (
        tenant(server, tmp_path / "full", "full", 2, "{aircraft: 1, grounds: 2}") as nodes,
        tenant(server, tmp_path / "other", "other", 1, "{aircraft: 1}") as other,
    ):
        aircraft, ground, air_token, token = nodes.pair(0, 1, "glider-1")
        listener, _ = nodes.ground(0, "glider-1", access="listen")
        with alive(aircraft, ground, listener):
            until(lambda: usage(nodes, 1, "aircraft") == 1, "the heartbeat of the first node")
            until(lambda: usage(nodes, 1, "grounds") == 2, "the heartbeat of the first node")
            here = nodes.programs[1]
            assert refusal(here.airborne_port, "UP1 aircraft=glider-2\n") == "quota"
            assert refusal(here.ground_port, "UP1 aircraft=glider-1 seat=command\n") == "quota"
            wrong = f"UP1 aircraft=glider-1 seat=command token={'0' * 32}\n"
            assert refusal(here.ground_port, wrong) == "quota"
            with other.aircraft(0, "glider-2")[0]:
                # Its own reconnection is not a new one: at the other node, too.
                moved, _ = nodes.aircraft(1, "glider-1", air_token)
                resumed, _ = nodes.ground(0, "glider-1", token=token)
                with alive(moved, resumed):
                    resumed.expect("seat command")
                    relayed(moved, resumed, "after both have moved")
                    check_shown(server, tmp_path)


def test_a_full_quota_refuses_neither_a_drained_aircraft_nor_the_ground_that_gets_control(
    server, tmp_path
):
    with tenant(server, tmp_path / "used", "used", 2, "{mb_per_hour: 1}") as nodes:
        aircraft, token = nodes.aircraft(0, "glider-1")
        with alive(aircraft):
            for _ in range(21):
                aircraft.say("x" * 49_999 + "\n")
            until(lambda: usage(nodes, 1, "hour_bytes") > 1e6, "the heartbeat of the first node")
            port = nodes.programs[1].ground_port
            assert refusal(port, "UP1 aircraft=glider-1 seat=listen\n") == "quota"
            owner, _ = nodes.ground(1, "glider-1")
            with alive(owner):
                owner.expect("seat command")
                assert refusal(port, "UP1 aircraft=glider-1 seat=command\n") == "quota"
                fleet = UpFleet(tmp_path / "fleet", server.urls, "tenant: used\n")
                place = fleet.ask("where", "glider-1")["places"][0]
                assert fleet.ask("drain", place["id"])["left"] == ["glider-1"]
                assert refusal(nodes.programs[1].airborne_port, "UP1 aircraft=b\n") == "quota"
                nodes.aircraft(1, "glider-1", token)[0].close()


def check_shown(server, folder):
    fleet = UpFleet(folder / "fleet", server.urls, "tenant: full\n")

    def with_bytes():
        # The node counts them now and then.
        shown = fleet.ask("usage")
        return shown if shown["tenant"]["usage"]["hour_bytes"] > 0 else None

    shown = until(with_bytes, "the bytes of the hour")
    assert {each["state"] for m in shown["members"] for each in m["guests"]} == {"guest"}
    tenant = shown["tenant"]
    assert (tenant["name"], tenant["quota"]) == ("full", {"aircraft": 1, "grounds": 2})
    assert tenant["usage"]["aircraft"] >= 1
    lines = [line.split() for line in usage_table(shown)]
    assert [(line[0], line[-1]) for line in lines if line[1:2] == ["grounds"]] == [("full", "2")]
