"""Three proxies and three NATS servers, as real processes."""

import json
import signal
import time

import pytest

from tests.proxy.cluster.nodes import (
    Nodes,
    RawNats,
    alive,
    burst,
    heard_until,
    is_closed_after,
    packed,
    refusal,
    relayed,
)
from tests.proxy.program import Client
from tests.support.nats_servers import NatsServers
from tests.support.waiting import until
from up.protocols.proxy_lines import Access
from up_proxy.cluster.node_messages import (
    Beacon,
    GroundList,
    ListedGround,
    pack_batch,
    parse,
    parse_batch,
    unpack,
)


@pytest.fixture(scope="module")
def nodes(tmp_path_factory):
    with (
        NatsServers(tmp_path_factory.mktemp("nats")) as servers,
        Nodes(servers, tmp_path_factory.mktemp("proxies")) as running,
    ):
        yield running


def test_a_pair_on_two_nodes_and_a_second_aircraft_of_the_name(nodes):
    aircraft, ground, _, _ = nodes.pair(0, 1, "a.b-1")
    with aircraft, ground:
        relayed(aircraft, ground, "first")
        port = nodes.programs[2].airborne_port
        assert refusal(port, "UP1 aircraft=a.b-1\n") == "taken"
        assert refusal(port, f"UP1 aircraft=a.b-1 token={'0' * 32}\n") == "token"
        listener, _ = nodes.ground(2, "a.b-1")
        with listener:
            listener.expect("seat holder=1")
            listener.say('{"up": "of a listener"}\n')
            aircraft.expect("watch grounds=2")  # The home knows the listener.
            ground.say("UP1 seat give to=2\n")
            listener.expect("seat command")
            relayed(aircraft, listener, "given")


def test_lines_of_many_pairs_at_once(nodes):
    pairs = [nodes.pair(0, 1, f"burst-{number}") for number in range(10)]
    with alive(*(end for pair in pairs for end in pair[:2])):
        burst(pairs)


def test_an_aircraft_moves_and_its_ground_keeps_control(nodes):
    old, ground, air_token, _ = nodes.pair(0, 1, "moves")
    listener, _ = nodes.ground(0, "moves")
    new, token = nodes.aircraft(2, "moves", air_token)
    with old, ground, listener, new:
        assert token == air_token
        new.expect("watch grounds=2")
        relayed(new, ground, "moved")
        assert b'"moved"' not in b"".join(iter(old.file.readline, b""))
        listener.expect('"down": "moved"')


def test_a_killed_node(nodes):
    aircraft, ground, air_token, _ = nodes.pair(0, 1, "killed")
    far, near, _, token = nodes.pair(1, 0, "ground-killed")
    nodes.programs[0].end(signal.SIGKILL)
    began_s = time.monotonic()
    new, _ = nodes.aircraft(2, "killed", air_token)
    resumed, _ = nodes.ground(2, "ground-killed", token=token)
    with aircraft, ground, far, near, new, resumed:
        resumed.expect("seat command")
        new.expect("watch grounds=1")
        relayed(new, ground, "after the kill")
        relayed(far, resumed, "after the kill")
        assert time.monotonic() - began_s < 15.0, "it waited for the lease to expire"
    nodes.restart(0)


def test_a_stopped_node_leaves_its_aircraft_to_the_others(nodes):
    aircraft, ground, _, _ = nodes.pair(0, 1, "drained")
    assert nodes.programs[0].end(signal.SIGTERM) == 0
    # Without a token: the record is free.
    new, _ = nodes.aircraft(2, "drained")
    with aircraft, ground, new:
        new.expect("watch grounds=1")
        relayed(new, ground, "after the end")
    nodes.restart(0)


def test_an_aircraft_that_all_have_left_has_no_lease(nodes):
    with RawNats(nodes.servers.ports[1]) as written:
        written.subscribe("$KV.up-leases.aircraft.default.left")
        aircraft, _ = nodes.aircraft(0, "left")
        with nodes.ground(0, "left", "listen")[0]:
            aircraft.close()
            while json.loads(written.message().payload)["data"]["air"] is not None:
                pass
        while (last := written.message()).payload:
            pass
        assert b"PURGE" in last.header  # not the end of its time to live


def test_a_hung_node_finds_its_aircraft_elsewhere(nodes):
    hung, ground, air_token, _ = nodes.pair(0, 1, "hung")
    nodes.programs[0].process.send_signal(signal.SIGSTOP)
    new, _ = nodes.aircraft(2, "hung", air_token)
    with hung, alive(ground, new):
        hung.say('{"down": "of the past"}\n')
        new.expect("watch grounds=1")
        relayed(new, ground, "beside the hung node")
        nodes.programs[0].process.send_signal(signal.SIGCONT)
        # Its heartbeats keep it from the end of an idle connection.
        until(lambda: is_closed_after(hung, "\n"), "the end of the old connection")
        new.say('{"down": "last"}\n')
        assert "past" not in heard_until(ground, "last")


def test_old_messages_and_those_of_a_former_home_are_dropped(nodes):
    ground, _ = nodes.ground(1, "fenced")
    with ground, RawNats(nodes.servers.ports[1]) as home:
        beacon = Beacon(True, None).encode()
        nodes.introduce(1, home, "home")
        home.publish("up.default.fenced.control", packed("home", 10, 0, beacon))
        ground.expect("aircraft online")
        marks = (
            (10, 2.5, "old"),
            (10, 0.0, "young"),
            (10, 1.0, "overtaken"),
            (9, 0.0, "former home"),
            (10, 0.0, "last"),
        )
        for fence, age_s, mark in marks:
            line = f'{{"down": "{mark}"}}\n'.encode()
            home.publish("up.default.fenced.down", packed("home", fence, 0, line, age_s))
        heard = heard_until(ground, "last")
        assert [mark for *_, mark in marks if mark in heard] == ["young", "last"]


def test_a_line_about_control_that_a_guest_did_not_get_is_repeated(nodes):
    aircraft, _ = nodes.aircraft(0, "repeated")
    with aircraft, RawNats(nodes.servers.ports[1]) as guest:
        guest.subscribe("up.default.repeated.control")
        nodes.introduce(0, guest, "other")

        def say(*accesses):
            listed = [
                ListedGround(number, access, f"{number}" * 32, True, False, "::1", 0.0)
                for number, access in enumerate(accesses, 1)
            ]
            body = GroundList(tuple(listed)).encode()
            guest.publish("up.default.repeated.control", packed("other", 0, 0, body))

        def expect(ground, line):
            while True:
                news = unpack(guest.message().payload)
                if news.ground == ground and line in news.body:
                    return

        say(Access.COMMAND, Access.LISTEN)
        expect(1, b"seat command")
        for _ in range(2):
            say(Access.LISTEN, Access.COMMAND)
            expect(1, b"seat command")
            expect(2, b"seat listen")


def test_lists_and_beacons_are_repeated_in_batches(nodes):
    aircraft, _ = nodes.aircraft(0, "batched")
    (home,) = (each["node"] for each in nodes.programs[0].events if "node" in each)
    with aircraft, RawNats(nodes.servers.ports[1]) as guest:
        guest.subscribe("up.default.nodes.batcher")
        nodes.introduce(0, guest, "batcher")

        def listed(*numbers):
            grounds = [
                ListedGround(number, Access.LISTEN, f"{number}" * 32, True, False, "::1", 0.0)
                for number in numbers
            ]
            return GroundList(tuple(grounds)).encode()

        def say(body, age_s):
            guest.publish(f"up.default.nodes.{home}", packed("batcher", 0, 0, body, age_s))

        def known():
            ((name, _, beacon),) = parse_batch(unpack(guest.message().payload).body)
            assert name == "batched"
            return parse(beacon).known.get("batcher")

        entries = ("unknown", 0, listed(1)), ("batched", 0, b"nonsense"), ("batched", 0, listed(1))
        say(pack_batch(entries), age_s=1.5)
        assert known() == [1]
        guest.publish("up.default.batched.control", packed("batcher", 0, 0, listed(1, 2)))
        say(pack_batch([("batched", 0, listed())]), age_s=1.0)  # overtaken
        say(b"batched x\n", age_s=0.0)
        while known() != [1, 2]:
            pass


def test_a_line_for_a_former_home_reaches_no_aircraft(nodes):
    aircraft, _ = nodes.aircraft(0, "target")
    with aircraft, RawNats(nodes.servers.ports[1]) as guest:
        guest.subscribe("up.default.target.control")
        nodes.introduce(0, guest, "guest")
        ground = ListedGround(1, Access.COMMAND, "0" * 32, True, False, "::1", 0.0)

        def say(fence, kind, body):
            guest.publish(f"up.default.target.{kind}", packed("guest", fence, 1, body))

        say(0, "control", GroundList((ground,)).encode())
        fence = 0
        while b"seat command" not in (news := unpack(guest.message().payload)).body:
            fence = news.fence
        say(fence - 1, "up", b'{"up": "for a former home"}\n')
        say(fence, "up", b'{"up": "last"}\n')
        assert "former" not in heard_until(aircraft, "last")


def test_a_write_without_an_answer_keeps_control(nodes):
    """The node has written the record of an aircraft that it was about to admit."""
    waiting, _ = nodes.ground(0, "unanswered")
    owner, control = nodes.ground(0, "unanswered", token="c" * 32)
    (node,) = (each["node"] for each in nodes.programs[0].events if "node" in each)
    data = {"air": "a" * 32, "control": control}
    record = json.dumps({"node": node, "fence": 0, "data": data}).encode()
    with RawNats(nodes.servers.ports[0]) as written:
        written.store("$KV.up-leases.aircraft.default.unanswered", record)
    aircraft, token = nodes.aircraft(0, "unanswered", "a" * 32)
    with waiting, owner, aircraft:
        assert token == "a" * 32
        owner.expect("seat command")
        waiting.expect("seat listen")


def test_an_aircraft_that_left_before_its_lease_came_may_return(nodes):
    port = nodes.programs[0].airborne_port
    until(lambda: nodes.figure(0, "leases") == 0, "the end of the aircraft before")
    with nodes.servers.paused(0, 1, 2):
        with Client(port, "UP1 aircraft=hasty\n"):
            until(lambda: nodes.connections(0) == 1, "the connection")
        until(lambda: nodes.connections(0) == 0, "its end")
        again = Client(port, "UP1 aircraft=hasty\n")
        until(lambda: nodes.connections(0) == 1, "the second connection")
    with again:
        again.expect("UP1 ok ")


def test_pairs_of_one_node_go_on_without_nats(nodes):
    aircraft, ground, *_ = nodes.pair(1, 1, "alone")
    with alive(aircraft, ground):
        with nodes.servers.paused(0, 1, 2):
            until(lambda: nodes.figure(1, "connected") == 0, "the loss of NATS")
            relayed(aircraft, ground, "without NATS")
            assert refusal(nodes.programs[1].airborne_port, "UP1 aircraft=new\n") == "cluster"
            ground.say("UP1 seat release\nUP1 seat request\n")
            until(lambda: nodes.control_refused(1), "the refusal of control")
            aircraft.say('{"down": "not granted"}\n')
            assert "seat command" not in heard_until(ground, "not granted")
        until(lambda: nodes.figure(1, "connected") == 1, "NATS again")
        until(
            lambda: refusal(nodes.programs[2].airborne_port, "UP1 aircraft=alone\n") == "taken",
            "the lease, still held",
        )
        ground.say("UP1 seat request\n")
        ground.expect("seat command")
        relayed(aircraft, ground, "with NATS again")
