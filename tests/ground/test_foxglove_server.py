import json
import socket
import struct
import time

import pytest

from tests.ground import aircraft as air
from tests.ground.aircraft import Aircraft, Ground, codes, frame, ground
from tests.ground.foxglove_client import SUBPROTOCOL, connected, ended
from tests.support.reactor import run_in_reactor, until
from tests.support.waiting import until as wait_until
from up.flight_log.foxglove import LOCATION_FIX
from up_ground.foxglove_server import _place_of


def with_client(port, look):
    async def fly():
        client = await connected(port)
        await until(lambda: client.of("serverInfo"), what="serverInfo")
        await look(client)
        await ended(client)

    run_in_reactor(fly)


@pytest.fixture
def address(proxy, tmp_path):
    with Ground(tmp_path, proxy.ground_port, "foxglove", "--listen", "127.0.0.1:0") as server:
        server.expect("foxglove_open")
        yield server.event("foxglove_open")["address"]


def test_a_client_reads_telemetry_and_the_place(proxy, address):
    async def look(client):
        assert client.websocket_protocol_in_use == SUBPROTOCOL
        (info,) = client.of("serverInfo")
        assert (info["name"], info["capabilities"]) == (air.NAME, [])
        channels = await client.channels()
        frames, places = channels["up.telemetry.update"], channels["/location"]
        assert (frames["encoding"], places["schemaName"]) == ("json", LOCATION_FIX)
        roll = json.loads(frames["schema"])["properties"]["orientation"]["properties"]["roll"]
        assert roll["x-unit"] == "deg"
        await client.subscribe()
        await until(lambda: client.of("status"), what="the status of a silent aircraft")
        assert client.taken == {}
        with Aircraft(proxy.airborne_port):
            await until(lambda: {1, 2} <= client.taken.keys(), what="messages")
            await until(lambda: client.of("removeStatus"), what="the end of the status")
        time_ns, data = client.taken[1][0]
        assert abs(time.time_ns() - time_ns) < 60e9
        assert data == data | frame()
        _, place = client.taken[2][0]
        assert (place["latitude"], place["longitude"], place["altitude"]) == (50.0755, 14.4378, 312)
        count = len(client.of("status"))
        await until(lambda: len(client.of("status")) > count, what="silence")

    with_client(address, look)


def test_what_a_client_publishes_calls_or_sets_is_refused(proxy, address):
    async def look(client):
        def refusals():
            told = client.of("status") + client.of("serviceCallFailure")
            return [each for each in told if each.get("id") != "link"]

        channel = {"id": 9, "topic": "up.arm", "encoding": "json", "schemaName": ""}
        client.say("advertise", channels=[channel])
        client.sendMessage(struct.pack("<BI", 1, 9) + b"{}", isBinary=True)
        client.sendMessage(struct.pack("<BIII", 2, 1, 1, 4) + b"json{}", isBinary=True)
        client.say("setParameters", parameters=[{"name": "ratePIDs", "value": 1}])
        await until(lambda: len(refusals()) == 4, what=f"four refusals, {client.told}")

    with Aircraft(proxy.airborne_port) as aircraft:
        with_client(address, look)
        assert [each for each in aircraft.received if each] == []


def test_a_port_in_use_is_one_sentence(proxy, address, tmp_path):
    status, _, said = ground(tmp_path, proxy.ground_port, "foxglove", "--listen", address)
    assert (status, codes(said)) == (1, ["listen_failed"])


def test_without_a_client_the_log_has_why_there_are_no_frames(proxy, tmp_path):
    with socket.socket() as deaf:
        deaf.bind(("127.0.0.1", 0))
        arguments = ("foxglove", "--listen", "127.0.0.1:0")
        with Ground(tmp_path, deaf.getsockname()[1], *arguments) as server:
            wait_until(lambda: codes(server.stderr), lambda: server.said)
        assert codes(server.stderr) == ["unreachable"]
    with Ground(tmp_path, proxy.ground_port, *arguments) as server:
        wait_until(lambda: codes(server.stderr) == ["silent"], lambda: server.stderr)
        with Aircraft(proxy.airborne_port):
            server.expect("heard")


def test_a_stale_or_unknown_place_is_not_published():
    data = frame()
    assert _place_of(data, 10**18)["timestamp"] == {"sec": 999999999, "nsec": 400000000}
    for location, age_ms in (({}, 0), (data["location"], 1901), (data["location"], None)):
        assert _place_of(data | {"location": location, "age_ms": {"location": age_ms}}, 0) is None
