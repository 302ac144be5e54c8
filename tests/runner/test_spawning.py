"""Requests to a real runner that starts real processes."""

import os
import signal
import socket
from pathlib import Path

import pytest

from tests.runner.runners import Talk, can_connect, is_alive, same_instance, wait_until


def test_the_first_request_spawns_and_the_next_finds_it_running(runners):
    runner = runners(proxy={"host": "proxy.example", "ground port": 4004}).start()
    first = runner.ask()
    assert first["message"] == "Raspilot spawned"
    assert first["spawned"] is True and first["running"] is True and first["error"] is None
    assert first["myAddress"] == "127.0.0.1" and first["instance"] == "glider-1"
    assert first["proxy"] == {"host": "proxy.example", "airborne": 3003, "ground": 4004}
    assert is_alive(first["pid"])
    assert can_connect(first["ports"]["general"]) and can_connect(first["ports"]["orientation"])
    assert same_instance(runner.ask(), first)
    assert "started as glider-1 in mode black box" in runner.log()


def test_status_starts_nothing(runner):
    response = runner.status()
    assert response["running"] is False and response["pid"] is None and response["error"] is None
    assert runner.instances() == []
    spawned = runner.spawn()
    assert runner.status()["pid"] == spawned["pid"]


@pytest.mark.parametrize("bytes_", [b"\n", b"\x00\xff"])
def test_any_bytes_of_a_legacy_client_spawn_the_default_instance(runner, bytes_):
    talk = runner.talk()
    first = talk.ask(bytes_)
    assert first["spawned"] is True and first["instance"] == "default"
    assert same_instance(talk.ask(b"x"), first)


def test_twenty_simultaneous_requests_start_one_process(runner):
    gate = runner.close_gate()
    talks = [runner.talk() for _ in range(20)]
    for talk in talks:
        talk.say({"aircraft": runner.name})
    wait_until(runner.instances, "it starts")
    gate.touch()
    responses = [talk.hear() for talk in talks]
    assert [each["spawned"] for each in responses].count(True) == 1
    assert {each["pid"] for each in responses} == set(runner.instances())
    assert all(each["running"] and each["ports"] for each in responses)


def test_all_clients_receive_the_reason_of_a_failed_start(runner):
    runner.write("blackbox/behaviour.yml", {"complaint": "android.yml:3:7: must be a number"})
    talks = [runner.talk() for _ in range(3)]
    for talk in talks:
        talk.say({"aircraft": runner.name})
    for talk in talks:
        response = talk.hear()
        assert response["running"] is False and response["spawned"] is False
        assert response["code"] == "start_failed"
        assert "android.yml:3:7:" in response["error"]
    assert runner.status()["running"] is False


def test_a_repeated_failing_request_does_not_start_a_process_each_time(runner):
    runner.write("blackbox/behaviour.yml", {"complaint": "no good"})
    talk = runner.talk()
    for _ in range(100):
        assert talk.ask({"aircraft": runner.name})["code"] == "start_failed"
    assert runner.log().count("started as") < 100
    runner.write("blackbox/behaviour.yml", {})
    wait_until(lambda: runner.ask()["spawned"], "a moment later it is tried again")


def test_several_instances_run_side_by_side_on_their_own_ports(runner):
    responses = [runner.spawn(f"plane-{number}") for number in range(4)]
    ports = [port for each in responses for port in each["ports"].values()]
    assert len(set(ports)) == 8 and len({each["pid"] for each in responses}) == 4
    for each in responses:
        named = runner.talk(each["ports"]["general"]).order("environ UP_INSTANCE")
        assert named == each["instance"]


def test_the_number_of_instances_is_limited_and_a_refused_request_does_not_count(runners):
    runner = runners(instances=2).start()
    assert runner.ask(profile="ufo")["code"] == "unknown_profile"
    runner.spawn("a")
    runner.spawn("b")
    assert runner.ask(aircraft="c")["code"] == "instance_limit"
    assert runner.ask(aircraft="a")["running"] is True


def test_a_process_without_the_ports_that_it_reports_is_killed(runners):
    runner = runners(**{"start limit": 1.0}).start()
    for name, behaviour, code in (
        ("silent", {"says nothing": True}, "not_ready"),
        ("lying", {"lies": True}, "port_not_bound"),
    ):
        runner.write("blackbox/behaviour.yml", behaviour)
        response = runner.ask(aircraft=name)
        assert response["spawned"] is False and response["running"] is False
        assert response["pid"] is None and response["code"] == code
        wait_until(lambda: not runner.instances(), "it was killed")


def test_a_port_in_use_is_the_error_of_the_instance(runner):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        runner.write("blackbox/android.yml", {"general port": taken.getsockname()[1]})
        response = runner.ask()
    assert response["code"] == "start_failed" and "in use" in response["error"]


def test_a_program_that_cannot_be_started(runners, short_path):
    script = short_path / "main.py"
    script.write_text("")
    runner = runners(**{"script path": str(script)}).start()
    script.unlink()
    response = runner.ask()
    assert response["spawned"] is False and response["code"] == "cannot_spawn"
    assert runners(python="/nowhere/python").start().ask()["code"] == "cannot_spawn"
    # Its log cannot be opened.
    assert runners(**{"logs folder": "/proc/nothing"}).start().ask()["code"] == "cannot_spawn"


def test_other_requests_are_handled_while_an_instance_starts(runner):
    gate = runner.close_gate()
    slow = runner.talk()
    slow.say({"aircraft": "slow"})
    wait_until(runner.instances, "it starts")
    runner.write("blackbox/behaviour.yml", {})
    assert runner.spawn()["spawned"] is True
    assert runner.status("slow")["code"] == "starting"
    gate.touch()
    assert slow.hear()["spawned"] is True


def test_a_client_that_disconnects_does_not_undo_the_start(runner):
    gate = runner.close_gate()
    talk = Talk(runner.port)
    talk.say({"aircraft": runner.name})
    wait_until(runner.instances, "it starts")
    talk.close()
    gate.touch()
    assert runner.spawn()["spawned"] is False


def test_no_secret_reaches_an_instance_by_default(runners):
    runner = runners()
    runner.environ = {"UP_GROUND_KEY": "secret", "PYTHONPATH": "/nowhere", "TZ": "UTC"}
    response = runner.start().spawn()
    environ = Path(f"/proc/{response['pid']}/environ").read_bytes()
    names = {word.partition(b"=")[0].decode() for word in environ.split(b"\0") if word}
    own = {"NOTIFY_SOCKET", "UP_INSTANCE", "UP_MODE", "UP_PID_FILE", "WATCHDOG_USEC"}
    own.add("PYTHONUNBUFFERED")
    assert own | {"TZ", "PATH"} <= names
    assert names - own <= {"HOME", "LANG", "LANGUAGE", "PATH", "TZ", "XDG_STATE_HOME"} | {
        name for name in names if name.startswith("LC_")
    }


def test_an_instance_inherits_only_the_listed_variables_and_has_its_own_session(runners):
    runner = runners(environment=["PATH", "HOME", "LC_*", "CHOSEN"])
    runner.environ = {
        "LISTEN_FDS": "1",
        "RUNTIME_DIRECTORY": str(runner.run_folder),
        "AWS_SECRET_ACCESS_KEY": "secret",
        "HOMELY": "x",
        "LC_TIME": "C.UTF-8",
        "CHOSEN": "by the configuration",
    }
    response = runner.start().spawn()
    talk = runner.talk(response["ports"]["general"])
    # Standard streams, two listeners, this connection, and the folder that is being listed.
    assert set(talk.order("descriptors").split()) <= {"0", "1", "2", "3", "4", "5", "6"}
    session, group, _ = talk.order("session").split(" ", 2)
    assert int(session) == int(group) == response["pid"]
    expected = {
        "PATH": os.environ["PATH"],
        "LC_TIME": "C.UTF-8",
        "CHOSEN": "by the configuration",
        "LISTEN_FDS": "absent",
        "AWS_SECRET_ACCESS_KEY": "absent",
        # Not a prefix match.
        "HOMELY": "absent",
        "INVOCATION_ID": "absent",
        "WATCHDOG_USEC": "2000000",
        "NOTIFY_SOCKET": str(runner.run_folder / "glider-1" / "notify"),
    }
    assert {name: talk.order(f"environ {name}") for name in expected} == expected
    descriptors = Path(f"/proc/{response['pid']}/fd")
    assert (descriptors / "0").readlink() == Path("/dev/null")
    for output in ("1", "2"):
        assert (descriptors / output).readlink() == runner.logs_folder / "glider-1.log"


def test_base_profile_and_request_make_the_configuration(runner):
    runner.write("blackbox/load_guard.yml", {"interval": 0.5, "panic threshold": 80})
    runner.write("profiles/easyglider/load_guard.yml", {"panic threshold": 70})
    request = {"profile": "easyglider", "configuration": {"load_guard.yml": {"interval": 2}}}
    response = runner.spawn(**request)
    assert runner.config("load_guard.yml") == {"interval": 2, "panic threshold": 70}
    assert runner.config("android.yml") == {"general port": 0, "orientation port": 0}
    assert runner.ask(**request)["error"] is None
    other = runner.ask(profile="cub")
    assert other["running"] is True and other["pid"] == response["pid"]
    assert other["code"] == "other_configuration"
    assert runner.ask()["error"] is None


def test_files_of_an_instance_are_kept_until_the_profile_changes(runner):
    runner.write("blackbox/pids.yml", {"p": 1.0})
    runner.write("profiles/cub/pids.yml", {"p": 5.0})
    runner.spawn()
    assert runner.config("pids.yml") == {"p": 1.0}
    (runner.run_folder / runner.name / "config" / "pids.yml").write_text("p: 2.5\n")
    for profile, expected in ((None, 2.5), ("cub", 5.0)):
        os.kill(runner.status()["pid"], signal.SIGTERM)
        wait_until(lambda: not runner.instances(), "it ended")
        wait_until(lambda: not runner.status()["running"], "it is removed")
        runner.spawn(**({"profile": profile} if profile else {}))
        assert runner.config("pids.yml") == {"p": expected}
