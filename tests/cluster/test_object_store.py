"""Objects in a real NATS server, as ADR-20 lays them out."""

import hashlib
import json
from base64 import urlsafe_b64decode, urlsafe_b64encode

import pytest

from tests.cluster.connected import connected
from tests.support.nats_servers import NatsServers
from up_cluster.errors import UnavailableError, WrongRevisionError
from up_cluster.jetstream import EXPECTED, api, stored, write
from up_cluster.object_store import CHUNK_BYTES, ObjectDamagedError, ObjectStore


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with NatsServers(tmp_path_factory.mktemp("nats"), 1) as running:
        yield running


async def test_the_life_of_an_object(server):
    client = await connected(server)
    store = ObjectStore(client, "up-state")
    await store.create(1)
    await store.create(1)
    name, data = "default/glider-1/flights/0001.mcap", bytes(range(256)) * 1100
    assert await store.info(name) is None
    made = await store.put_bytes(name, data, 0)
    info = await store.info(name)
    assert info == made and (info.size, info.chunks) == (len(data), 3)
    assert await store.get_bytes(info) == data

    # As other clients read it.
    meta = f"$O.up-state.M.{urlsafe_b64encode(name.encode()).decode()}"
    found = await stored(client, "OBJ_up-state", {"last_by_subj": meta})
    fields = json.loads(found.data)
    kind, _, digest = fields["digest"].partition("=")
    assert kind == "SHA-256" and urlsafe_b64decode(digest) == hashlib.sha256(data).digest()
    assert (fields["name"], fields["bucket"], fields["chunks"]) == (name, "up-state", 3)
    query = {"seq": 1, "next_by_subj": f"$O.up-state.C.{fields['nuid']}"}
    assert (await stored(client, "OBJ_up-state", query)).data == data[:CHUNK_BYTES]

    # A writer that does not know the present revision replaces nothing, and leaves nothing.
    with pytest.raises(WrongRevisionError):
        await store.put_bytes(name, b"of a former host", info.revision - 1)
    assert await store.get_bytes(info) == data
    newer = await store.put_bytes(name, b"new", info.revision)
    state = (await api(client, "STREAM.INFO.OBJ_up-state", {}))["state"]
    assert state["messages"] == 2, "the chunk and the description"

    # The chunks of a write that NATS did not take to its end go with the next one.
    parts = iter([b"first chunk"])

    def until_lost(_size):
        for part in parts:
            return part
        raise UnavailableError("timeout")

    with pytest.raises(UnavailableError):
        await store.put("lost", until_lost)
    newer = await store.put_bytes(name, b"new", newer.revision)
    state = (await api(client, "STREAM.INFO.OBJ_up-state", {}))["state"]
    assert state["messages"] == 2
    empty = await store.put_bytes("empty", b"")
    assert await store.get_bytes(empty) == b""

    # An object that differs from the written one is not returned.
    chunk = await stored(client, "OBJ_up-state", {"seq": 1, "next_by_subj": "$O.up-state.C.*"})
    await write(client, chunk.subject, b"wen")
    await api(client, "STREAM.MSG.DELETE.OBJ_up-state", {"seq": chunk.sequence})
    await damaged(store, newer, "digest")
    await api(client, "STREAM.PURGE.OBJ_up-state", {"filter": chunk.subject})
    await damaged(store, newer, "chunk_missing")
    await write(client, meta, b"{}", {EXPECTED: str(newer.revision), "Nats-Rollup": "sub"})
    with pytest.raises(ObjectDamagedError) as error:
        await store.info(name)
    assert error.value.code == "info"
    again = await store.put_bytes(name, b"again", error.value.revision)
    assert await store.get_bytes(again) == b"again"
    await client.stop()


async def damaged(store, info, code):
    with pytest.raises(ObjectDamagedError) as error:
        await store.get_bytes(info)
    assert error.value.code == code
