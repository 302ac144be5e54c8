"""The files of an instance in the object store of a real NATS server, seen by two hosts."""

import json

import pytest
from twisted.internet.threads import deferToThread
from twisted.logger import capturedLogs

from tests.cluster.connected import connected
from tests.support.nats_servers import NatsServers
from up_cluster.errors import UnavailableError, WrongRevisionError
from up_cluster.object_store import ObjectStore
from up_runner.pool.state_files import FLIGHTS, StateFiles

LEARNED = ("pids.yml", "mission.json")
OBJECT = "t/glider/state"


class Host:
    """A machine: the folder of its instances."""

    def __init__(self, folder):
        self.folder = folder
        self.config = folder / "glider" / "config"
        self.config.mkdir(parents=True)

    def on_disk(self, function, *arguments):
        return deferToThread(function, *arguments)

    in_thread = on_disk

    def files(self, store):
        return StateFiles(store, self, "glider", "t/glider", LEARNED)

    def write(self, **texts):
        for name, text in texts.items():
            (self.config / name.replace("_", ".")).write_text(text)

    def present(self):
        return {each.name: each.read_text() for each in sorted(self.config.iterdir())}


def never():
    """Of a host whose lease has ended."""
    return False


def always():
    """Of a host that holds the lease."""
    return True


class SilentStore:
    """A store that writes, and loses the answer."""

    is_silent = False

    def __init__(self, store):
        self._store = store
        self.info, self.get_bytes = store.info, store.get_bytes

    async def put_bytes(self, *arguments):
        return self._lost(await self._store.put_bytes(*arguments))

    async def put_file(self, *arguments):
        return self._lost(await self._store.put_file(*arguments))

    def _lost(self, answer):
        if self.is_silent:
            raise UnavailableError("timeout")
        return answer


async def test_files_move_from_host_to_host(tmp_path):
    (tmp_path / "nats").mkdir()
    with NatsServers(tmp_path / "nats", 1) as server:
        client = await connected(server)
        store = ObjectStore(client, "up-state")
        await store.create(1)
        await move(store, tmp_path)
        await client.stop()


async def move(store, folder):
    """Let two hosts write and read one aircraft's files, in any store."""
    store = SilentStore(store)
    a, b = Host(folder / "a"), Host(folder / "b")

    # The first host of all keeps and saves its own files, and no others.
    a.write(pids_yml="gains", other_yml="configuration")
    (a.folder / "glider" / "profile").write_text("cub\n")
    first = a.files(store)
    await first.restore()
    await first.save(never)
    assert a.present() == {"other.yml": "configuration", "pids.yml": "gains"}
    revision = (await store.info(OBJECT)).revision
    await first.save(never)
    assert (await store.info(OBJECT)).revision == revision, "nothing has changed"

    # The next one replaces those that it had.
    b.write(pids_yml="old", mission_json="old")
    second = b.files(store)
    await second.restore()
    assert b.present() == {"pids.yml": "gains"}
    assert (b.folder / "glider" / "profile").read_text() == "cub\n"
    await second.save(never)

    # A former host cannot replace the state of its successor, even the same one.
    a.write(pids_yml="of a former host")
    with pytest.raises(WrongRevisionError):
        await first.save(never)
    b.write(mission_json="new")
    await second.save(never)
    with pytest.raises(WrongRevisionError):
        await first.save(never)
    document = json.loads(await store.get_bytes(await store.info(OBJECT)))
    assert document["files"] == {"mission.json": "new", "pids.yml": "gains"}

    # What comes late from one without the lease is replaced by the one that holds it.
    await store.put_bytes(OBJECT, b"late")
    b.write(mission_json="newer")
    await second.save(always)
    document = json.loads(await store.get_bytes(await store.info(OBJECT)))
    assert document["files"]["mission.json"] == "newer"

    # A state that could not be saved is kept on its host, until another host has written one.
    b.write(mission_json="unsaved")
    second = b.files(store)
    await second.restore()
    assert b.present()["mission.json"] == "unsaved"
    await second.save(never)
    successor = a.files(store)
    await successor.restore()
    a.write(mission_json="successor")
    await successor.save(never)
    b.write(mission_json="too late")
    second = b.files(store)
    await second.restore()
    assert b.present()["mission.json"] == "successor"

    # A write without an answer does not stop those after it.
    store.is_silent = True
    b.write(mission_json="unanswered")
    with pytest.raises(UnavailableError):
        await second.save(never)
    store.is_silent = False
    b.write(mission_json="answered")
    await second.save(never)
    third = a.files(store)
    await third.restore()
    assert a.present()["mission.json"] == "answered"

    # A damaged state, or one that names other files, is not used; the next save replaces it.
    for content in (
        b"[",
        b'{"profile": "", "files": {"../other.yml": "x", "other.yml": "x"}}',
        b'{"profile": "", "files": {"pids.yml": "\\ud800"}}',
    ):
        await store.put_bytes(OBJECT, content)
        await third.restore()
        assert a.present() == {"other.yml": "configuration"}
    await third.save(never)
    document = json.loads(await store.get_bytes(await store.info(OBJECT)))
    assert document["files"] == {}

    # A learned file that is not text is named in the log, and does not stop the others.
    a.write(pids_yml="gains")
    (a.config / "mission.json").write_bytes(b"\xff")
    (a.folder / "glider" / "profile").write_bytes(b"\xff")
    with capturedLogs() as events:
        await third.save(never)
    codes = [each["code"] for each in events if each["log_namespace"] == "runner.pool"]
    assert codes == ["state_file_damaged", "state_file_damaged", "state_saved"]
    document = json.loads(await store.get_bytes(await store.info(OBJECT)))
    assert document["profile"] == "\n"
    assert document["files"] == {"pids.yml": "gains"}
    (a.config / "mission.json").unlink()

    # Flights leave the host only when they are in the store.
    flights = a.folder / "glider" / FLIGHTS
    flights.mkdir(parents=True)
    (flights / "0001-a.mcap").write_bytes(b"flight")
    store.is_silent = True
    await third.save_flights()
    assert (flights / "0001-a.mcap").read_bytes() == b"flight"
    store.is_silent = False
    await third.save_flights()
    assert not (a.folder / "glider" / "state").exists()
    info = await store.info("t/glider/flights/0001-a.mcap")
    assert await store.get_bytes(info) == b"flight"
