"""The pool with the real Raspilot: its own watch of the deadline, its flight log."""

import os
import signal

from tests.cluster.connected import connected
from tests.runner.pool.runner_pool import RunnerPool
from tests.runner.raspilot_copy import copy_of_raspilot
from tests.runner.runners import is_alive, wait_until
from tests.support.nats_servers import NatsServers
from tests.support.reactor import run_in_reactor
from up_cluster.object_store import ObjectStore

MAGIC = b"\x89MCAP0\r\n"


def test_it_ends_at_its_deadline_and_its_flights_are_kept(tmp_path, short_path):
    settings = copy_of_raspilot(short_path / "application", ("android_cog", "black_box_cog"))
    files = {"black_box.yml": {"always": True, "keep free (MB)": 0}}
    with (
        NatsServers(tmp_path, 1) as servers,
        RunnerPool(servers, short_path, 2, files=files, **settings) as pool,
    ):
        first = pool.runners[0].spawn("real")
        host, other = pool.host_of(first), pool.others(pool.host_of(first))[0]
        host.process.send_signal(signal.SIGSTOP)
        second = pool.running_at(other, "real")
        assert not is_alive(first["pid"]) and second["host"] != first["host"]
        host.process.send_signal(signal.SIGCONT)
        os.kill(second["pid"], signal.SIGTERM)
        # One ended at its deadline without a word, one in order.
        names = [each.logs("flight_saved")["name"] for each in (host, other)]
        assert all(name.startswith(f"{pool.tenant}/real/flights/") for name in names)
        for runner in pool.runners:
            wait_until(lambda r=runner: not (r.run_folder / "real" / "state").exists(), "removed")
        run_in_reactor(check_flights, servers, names)


def test_it_sleeps_without_its_phone(tmp_path, short_path):
    settings = copy_of_raspilot(short_path / "application", ("android_cog", "black_box_cog"))
    settings["exit on connection lost"] = False
    files = {"black_box.yml": {"always": True, "keep free (MB)": 0}}
    with (
        NatsServers(tmp_path, 1) as servers,
        RunnerPool(
            servers, short_path, 1, pool={"sleep_after_s": 1.0}, files=files, **settings
        ) as pool,
    ):
        (runner,) = pool.runners
        first = runner.spawn("real")
        runner.logs("ended", cause="asleep")
        runner.logs("flight_saved")
        wait_until(lambda: runner.status("real")["code"] == "asleep", "it sleeps")
        assert runner.spawn("real")["pid"] != first["pid"]


async def check_flights(servers, names):
    client = await connected(servers)
    store = ObjectStore(client, "up-state")
    flights = [await store.get_bytes(await store.info(name)) for name in names]
    assert [(each.startswith(MAGIC), each.endswith(MAGIC)) for each in flights] == [
        (True, False),
        (True, True),
    ]
    await client.stop()
