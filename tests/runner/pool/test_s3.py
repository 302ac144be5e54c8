"""The files of a pool's instances in a real S3 service: the store, and two runners with it."""

import json
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest
from twisted.internet.threads import deferToThread

from tests.cluster.fleet.up_fleet import UpFleet
from tests.runner.pool.runner_pool import RunnerPool
from tests.runner.pool.test_state_files import move
from tests.support.nats_servers import NatsServers
from tests.support.reactor import reactor
from tests.support.s3_server import BUCKET, KEY, SECRET, S3Server
from tests.support.waiting import until
from up_cluster import s3_store
from up_cluster.errors import RefusedError, UnavailableError, WrongRevisionError
from up_cluster.object_store import ObjectDamagedError
from up_cluster.s3_store import MAX_THREADS, UNCONDITIONAL, S3Store, S3Threads
from up_runner.pool.state_files import FLIGHTS


@pytest.fixture(scope="module")
def s3(tmp_path_factory):
    with S3Server(tmp_path_factory.mktemp("s3")) as server:
        yield server


def store_at(endpoint, bucket=BUCKET, secret=SECRET):
    more = {"endpoint": endpoint, "region": "eu-north-1", "key": KEY, "secret": secret}
    return S3Store(deferToThread, bucket, **more)


async def test_files_move_from_host_to_host(s3, tmp_path):
    await move(store_at(s3.endpoint), tmp_path)


async def test_only_the_expected_revision_is_replaced(s3):
    store, name = store_at(s3.endpoint), "t/replaced/state"
    await store.create("t")
    with pytest.raises(WrongRevisionError):
        await store.put_bytes(name, b"1", '"0"')
    first = await store.put_bytes(name, b"1", 0)
    with pytest.raises(WrongRevisionError):
        await store.put_bytes(name, b"2", 0)
    second = await store.put_bytes(name, b"2", first.revision)
    with pytest.raises(WrongRevisionError):
        await store.put_bytes(name, b"3", first.revision)
    assert await store.info(name) == second
    assert await store.get_bytes(second) == b"2"
    # Somebody else wrote it: the digest is not that of the content.
    metadata = {"sha256": "0" * 64}
    s3.client().put_object(Bucket=BUCKET, Key=name, Body=b"other", Metadata=metadata)
    with pytest.raises(ObjectDamagedError):
        await store.get_bytes(await store.info(name))


async def test_a_refusal_and_no_answer(s3):
    with pytest.raises(RefusedError) as refused:
        await store_at(s3.endpoint, secret="wrong").put_bytes("t/x", b"")
    assert refused.value.code == "SignatureDoesNotMatch"
    assert await store_at(s3.endpoint).info("t/absent") is None
    with pytest.raises(RefusedError) as refused:
        await store_at(s3.endpoint, bucket="absent").info("t/absent")
    assert refused.value.code == "404"
    with pytest.raises(UnavailableError):
        await store_at("http://127.0.0.1:1").info("t/x")


async def test_a_service_that_hangs_gives_no_answer(s3, monkeypatch, tmp_path):
    monkeypatch.setattr(s3_store, "READ_LIMIT_S", 0.2)
    store, path = store_at(s3.endpoint), tmp_path / "flight"
    path.write_bytes(b"flight")
    with s3.paused():
        for request in store.info("t/x"), store.put_bytes("t/x", b""), store.put_file("t/x", path):
            with pytest.raises(UnavailableError):
                await request


class Ignorant(BaseHTTPRequestHandler):
    """Takes every write except those with the condition that it knows."""

    def do_PUT(self):
        self.rfile.read(int(self.headers.get("Content-Length", 0)))
        self.send_response(412 if self.headers.get(self.server.known) else 200)
        self.send_header("ETag", '"0"')
        self.send_header("Content-Length", "0")
        self.end_headers()

    def log_message(self, *_):
        """Do not print."""


@pytest.mark.parametrize("known", ["", "If-Match", "If-None-Match"])
async def test_a_service_that_ignores_conditions_is_refused(known):
    with ThreadingHTTPServer(("127.0.0.1", 0), Ignorant) as server:
        server.known = known
        threading.Thread(target=server.serve_forever).start()
        store = store_at(f"http://127.0.0.1:{server.server_port}")
        try:
            with pytest.raises(RefusedError) as refused:
                await store.create("t")
        finally:
            server.shutdown()
    assert refused.value.code == UNCONDITIONAL


async def test_threads_that_wait_for_s3_leave_those_of_the_reactor_free():
    threads, end = S3Threads(reactor), threading.Event()
    waiting = [threads(end.wait) for _ in range(2 * MAX_THREADS)]
    assert await deferToThread(lambda: "free") == "free"
    s3_threads = [each for each in threading.enumerate() if "s3" in each.name]
    assert len(s3_threads) == MAX_THREADS and all(each.daemon for each in s3_threads)
    end.set()
    assert all([await each for each in waiting])


def test_a_dead_host_leaves_its_files_to_another(s3, tmp_path, short_path):
    (tmp_path / "nats").mkdir()
    s3.credentials(tmp_path / "s3.txt")
    section = {**s3.pool, "s3_credentials": str(tmp_path / "s3.txt")}
    with (
        NatsServers(tmp_path / "nats", 1) as servers,
        RunnerPool(servers, short_path, 2, pool=section) as pool,
    ):
        host = pool.host_of(first := pool.runners[0].spawn("glider"))
        (host.run_folder / "glider" / "config" / "mission.json").write_text('{"plan": 1}')
        host.logs("state_saved", files=1)
        pool.kill_host(host)
        second = pool.running_at(other := pool.others(host)[0], "glider")
        assert second["pid"] != first["pid"]
        moved = other.run_folder / "glider" / "config" / "mission.json"
        assert moved.read_text() == '{"plan": 1}'
        flights = other.run_folder / "glider" / FLIGHTS
        flights.mkdir(parents=True)
        (flights / "0001-a.mcap").write_bytes(b"flight")
        fleet = UpFleet(short_path / "fleet", servers.urls, f"tenant: {pool.tenant}\n")
        # The last change comes while an earlier one is being saved.
        with s3.paused():
            moved.write_text('{"plan": 2}')
            until(s3.unread_bytes, "the save")
            moved.write_text('{"plan": 3}')
            fleet.ask("kick", "glider", "--instance")
            other.logs("ended", aircraft="glider")
        name = f"{pool.tenant}/glider/flights/0001-a.mcap"
        until(lambda: not flights.exists(), "the flight has left its host")
        found = s3.client().get_object(Bucket=BUCKET, Key=name)
        assert found["Body"].read() == b"flight"
        state = s3.client().get_object(Bucket=BUCKET, Key=f"{pool.tenant}/glider/state")
        assert json.load(state["Body"])["files"]["mission.json"] == '{"plan": 3}'
