"""Requests under a key, to a real runner and its processes."""

import shutil

import pytest

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
        place = run_in_reactor(
            spawn, reactor, Runner("127.0.0.1", runner.port, aircraft, pairing)
        )
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
    runner.logs("revoked") if ask(runner, fleet) == "revoked" else None
    assert len(runner.instances()) == 1
