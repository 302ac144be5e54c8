"""Requests under a key, to a real runner and its processes."""

from tests.runner.runners import wait_until
from tests.support.reactor import reactor, run_in_reactor
from up.config.keys_file import KEYS, add_key, revoke_key
from up.protocols.pairing import Pairing
from up_simulator.phone.address import NotFoundError, Runner, spawn


def pair(folder, aircraft="glider-1", name="phone"):
    key_id, key = add_key(folder, name, "pilot", "", aircraft)
    return Pairing("glider-1", key_id, key.secret, key.role, key.name)


def ask(runner, pairing, aircraft="glider-1"):
    """Request an instance as the phone does; return its ports, or the code of the refusal."""
    try:
        place = run_in_reactor(spawn, reactor, Runner("127.0.0.1", runner.port, aircraft, pairing))
    except NotFoundError as refusal:
        return refusal.code
    return {"general": place.general_port, "orientation": place.orientation_port}


def test_a_key_starts_instances_up_to_its_quota_which_survives_the_runner(runners):
    runner = runners(security="require", **{"key quota": {"instances": 1}})
    fleet = pair(runner.config_folder, "")
    runner.start()
    ports = ask(runner, fleet)
    assert runner.logs("request", action="spawn", device="phone")["aircraft"] == "glider-1"
    # A plain query tells nothing, not even to a legacy client.
    assert runner.status("glider-1")["code"] == "unprotected"
    assert runner.talk().ask(b"spawn\n")["code"] == "unprotected"
    runner.kill()
    runner.start()
    runner.logs("taken_over")
    assert ask(runner, fleet) == ports
    assert ask(runner, fleet, "glider-2") == "key_instances"
    revoke_key(runner.config_folder, "phone")
    wait_until(lambda: ask(runner, fleet) == "revoked", "the key is refused")
    assert len(runner.instances()) == 1


def test_a_runner_without_keys_takes_none_and_says_so(runners):
    runner = runners(security="off").start()
    assert ask(runner, pair(runner.folder)) == "protection_off"
    assert runner.ask(action="status")["code"] is None
    assert runner.instances() == []


def test_a_required_key_that_is_missing_is_logged_and_a_faulty_file_stops_the_start(runners):
    runner = runners(security="require").start()
    runner.logs("keys_missing")
    assert ask(runner, pair(runner.folder)) == "unknown_key"
    assert runner.terminate() == 0
    pair(runner.config_folder)
    (runner.config_folder / KEYS.filename).chmod(0o644)
    assert runner.launch().wait() == 1
    assert runner.events()[-1]["code"] == "keys_faulty"
