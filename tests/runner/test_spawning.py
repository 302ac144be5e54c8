"""Requests to a real runner that starts real processes."""

import os
import signal
import socket
import threading
from pathlib import Path

import pytest
import yaml

from tests.runner.runners import Talk, can_connect, is_alive, wait_until


def test_the_first_request_spawns_and_the_next_finds_it_running(runners):
    runner = runners(proxy={"host": "proxy.example", "ground port": 4004}).start()
    first = runner.ask(aircraft="glider-1")
    assert first["message"] == "Raspilot spawned"
    assert first["spawned"] is True and first["running"] is True and first["error"] is None
    assert first["myAddress"] == "127.0.0.1" and first["instance"] == "glider-1"
    assert first["proxy"] == {"host": "proxy.example", "airborne": 3003, "ground": 4004}
    assert is_alive(first["pid"])
    assert can_connect(first["ports"]["general"]) and can_connect(first["ports"]["orientation"])
    second = runner.ask(aircraft="glider-1")
    assert second == first | {"message": "Raspilot already running", "spawned": False}
    assert "started as glider-1 in mode black box" in runner.log()


def test_no_secret_reaches_an_instance_by_default(runners):
    runner = runners()
    runner.environ = {"UP_GROUND_KEY": "secret", "PYTHONPATH": "/nowhere", "TZ": "UTC"}
    answer = runner.start().spawn()
    environ = Path(f"/proc/{answer['pid']}/environ").read_bytes()
    names = {word.partition(b"=")[0].decode() for word in environ.split(b"\0") if word}
    own = {"NOTIFY_SOCKET", "UP_INSTANCE", "UP_MODE", "UP_PID_FILE", "WATCHDOG_USEC"}
    own.add("PYTHONUNBUFFERED")
    assert own | {"TZ", "PATH"} <= names
    assert names - own <= {"HOME", "LANG", "LANGUAGE", "PATH", "TZ", "XDG_STATE_HOME"} | {
        name for name in names if name.startswith("LC_")
    }


def test_the_keys_come_in_the_prototypes_order(runners):
    answer = runners().start().ask(action="status")
    assert list(answer)[:4] == ["message", "spawned", "error", "myAddress"]
    assert answer["proxy"] is None


def test_status_starts_nothing(runners):
    runner = runners().start()
    answer = runner.status()
    assert answer["message"] == "Raspilot not running" and answer["running"] is False
    assert answer["pid"] is None and answer["ports"] is None and answer["error"] is None
    assert runner.instances() == []
    spawned = runner.spawn()
    assert runner.status()["pid"] == spawned["pid"]


@pytest.mark.parametrize("bytes_", [b"\n", b"spawn", b"\x00\xff", b"1"])
def test_a_thesis_client_says_anything_and_gets_the_default_instance(runners, bytes_):
    runner = runners().start()
    answer = runner.talk().ask(bytes_)
    assert answer["message"] == "Raspilot spawned" and answer["instance"] == "default"


def test_a_thesis_client_asks_again_on_the_same_connection(runners):
    runner = runners().start()
    talk = runner.talk()
    assert talk.ask(b"x")["spawned"] is True
    assert talk.ask(b"x")["message"] == "Raspilot already running"
    assert len(runner.instances()) == 1


def test_a_first_line_that_is_never_finished_is_a_thesis_clients(runners):
    runner = runners().start()
    answer = runner.talk().ask(b'{"aircraft": "gli')
    assert answer["spawned"] is True and answer["instance"] == "default"


def test_a_whole_request_without_its_line_feed_is_what_it_says(runners):
    runner = runners().start()
    answer = runner.talk().ask(b'{"aircraft": "glider-1"}')
    assert answer["spawned"] is True and answer["instance"] == "glider-1"


def test_twenty_askers_at_once_start_one_process_and_all_get_the_truth(runners):
    runner = runners().start()
    gate = runner.close_gate()
    talks = [runner.talk() for _ in range(20)]
    for talk in talks:
        talk.say({"aircraft": "glider-1"})
    wait_until(runner.instances, "it starts")
    gate.touch()
    answers = [talk.hear() for talk in talks]
    assert [answer["spawned"] for answer in answers].count(True) == 1
    assert {answer["pid"] for answer in answers} == {answers[0]["pid"]}
    assert all(answer["running"] and answer["ports"] for answer in answers)
    assert runner.instances() == [answers[0]["pid"]]


def test_when_the_start_fails_all_askers_hear_so(runners):
    runner = runners().start()
    runner.write("blackbox/behaviour.yml", {"complaint": "android.yml:3:7: must be a number"})
    talks = [runner.talk() for _ in range(3)]
    for talk in talks:
        talk.say({"aircraft": "glider-1"})
    for talk in talks:
        answer = talk.hear()
        assert answer["message"] == "Raspilot not running" and answer["spawned"] is False
        assert "exit status 2" in answer["error"]
        assert "android.yml:3:7: must be a number" in answer["error"]
    assert runner.status()["running"] is False


def test_the_same_request_in_a_loop_does_not_start_a_process_each_time(runners):
    runner = runners().start()
    runner.write("blackbox/behaviour.yml", {"complaint": "no good"})
    talk = runner.talk()
    for _ in range(100):
        assert "no good" in talk.ask({"aircraft": "glider-1"})["error"]
    assert runner.log().count("started as") < 100
    runner.write("blackbox/behaviour.yml", {})
    assert talk.ask({"aircraft": "glider-2"})["spawned"] is True

    def asked_again():
        return talk.ask({"aircraft": "glider-1"})["spawned"]

    wait_until(asked_again, "a moment later it is tried again")


def test_several_instances_run_side_by_side_on_ports_of_their_own(runners):
    runner = runners().start()
    answers = [runner.spawn(f"glider-{number}") for number in range(4)]
    ports = [port for answer in answers for port in answer["ports"].values()]
    assert len(set(ports)) == 8 and len({answer["pid"] for answer in answers}) == 4
    for answer in answers:
        told = runner.talk(answer["ports"]["general"]).order("environ UP_INSTANCE")
        assert told == answer["instance"]


def test_more_instances_than_the_limit_are_refused(runners):
    runner = runners(instances=2).start()
    runner.spawn("a")
    runner.spawn("b")
    answer = runner.ask(aircraft="c")
    assert answer["running"] is False
    assert answer["error"] == "all 2 instances of this host are in use"
    assert runner.ask(aircraft="a")["running"] is True


def test_a_process_that_lives_but_binds_nothing_is_no_success(runners):
    runner = runners(**{"start limit": 1.0}).start()
    runner.write("blackbox/behaviour.yml", {"says nothing": True})
    answer = runner.ask(aircraft="glider-1")
    assert answer["spawned"] is False and answer["running"] is False and answer["pid"] is None
    assert answer["error"] == "Raspilot did not say that it is ready within 1 s"
    wait_until(lambda: not runner.instances(), "it was killed")


def test_a_process_that_claims_a_port_which_it_has_not_is_no_success(runners):
    runner = runners(**{"start limit": 1.0}).start()
    runner.write("blackbox/behaviour.yml", {"lies": True})
    answer = runner.ask(aircraft="glider-1")
    assert answer["running"] is False
    assert "has not bound its port orientation" in answer["error"]
    wait_until(lambda: not runner.instances(), "it was killed")


def test_a_taken_port_is_the_instances_error(runners):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        runner = runners().start()
        runner.write("blackbox/android.yml", {"general port": taken.getsockname()[1]})
        answer = runner.ask(aircraft="glider-1")
    assert answer["running"] is False and "Address already in use" in answer["error"]


def test_a_script_that_went_away_is_told_not_called_spawned(runners, short_path):
    script = short_path / "main.py"
    script.write_text("")
    runner = runners(**{"script path": str(script)}).start()
    script.unlink()
    answer = runner.ask(aircraft="glider-1")
    assert answer["spawned"] is False and "there is no script" in answer["error"]


def test_an_interpreter_that_is_not_there_is_told(runners):
    answer = runners(python="/nowhere/python").start().ask(aircraft="glider-1")
    assert answer["spawned"] is False and "No such file" in answer["error"]


def test_the_runner_answers_others_while_an_instance_starts(runners):
    runner = runners().start()
    gate = runner.close_gate()
    slow = runner.talk()
    slow.say({"aircraft": "slow"})
    wait_until(runner.instances, "it starts")
    runner.write("blackbox/behaviour.yml", {})
    assert runner.spawn("quick")["spawned"] is True
    assert runner.status("slow")["error"] == "Raspilot is starting"
    gate.touch()
    assert slow.hear()["spawned"] is True


def test_an_asker_who_leaves_does_not_undo_the_start(runners):
    runner = runners().start()
    gate = runner.close_gate()
    talk = Talk(runner.port)
    talk.say({"aircraft": "glider-1"})
    wait_until(runner.instances, "it starts")
    talk.close()
    gate.touch()
    assert runner.spawn()["spawned"] is False


def test_an_instance_inherits_nothing_and_has_a_session_of_its_own(runners):
    runner = runners(environment=["PATH", "HOME", "LC_*", "CHOSEN"])
    runner.environ = {
        "LISTEN_FDS": "1",
        "RUNTIME_DIRECTORY": str(runner.run_folder),
        "AWS_SECRET_ACCESS_KEY": "secret",
        "HOMELY": "x",
        "LC_TIME": "C.UTF-8",
        "CHOSEN": "by the configuration",
    }
    answer = runner.start().spawn()
    talk = runner.talk(answer["ports"]["general"])
    # Standard streams, two listeners, this connection, and the folder that is being listed.
    assert set(talk.order("descriptors").split()) <= {"0", "1", "2", "3", "4", "5", "6"}
    session, group, _ = talk.order("session").split(" ", 2)
    assert int(session) == int(group) == answer["pid"]
    assert talk.order("environ PATH") == os.environ["PATH"]
    assert talk.order("environ LC_TIME") == "C.UTF-8"
    assert talk.order("environ CHOSEN") == "by the configuration"
    assert talk.order("environ LISTEN_FDS") == "absent"
    assert talk.order("environ AWS_SECRET_ACCESS_KEY") == "absent"
    # Not what begins like an allowed name.
    assert talk.order("environ HOMELY") == "absent"
    assert talk.order("environ INVOCATION_ID") == "absent"
    assert talk.order("environ WATCHDOG_USEC") == "2000000"
    expected = str(runner.run_folder / "glider-1" / "notify")
    assert talk.order("environ NOTIFY_SOCKET") == expected
    descriptors = Path(f"/proc/{answer['pid']}/fd")
    assert (descriptors / "0").readlink() == Path("/dev/null")
    for output in ("1", "2"):
        assert (descriptors / output).readlink() == runner.logs_folder / "glider-1.log"


def test_base_profile_and_request_make_the_configuration(runners):
    runner = runners().start()
    runner.write("blackbox/load_guard.yml", {"interval": 0.5, "panic threshold": 80})
    runner.write("profiles/easyglider/load_guard.yml", {"panic threshold": 70})
    answer = runner.spawn(profile="easyglider", configuration={"load_guard.yml": {"interval": 2}})
    folder = runner.run_folder / "glider-1" / "config"
    assert yaml.safe_load((folder / "load_guard.yml").read_text()) == {
        "interval": 2,
        "panic threshold": 70,
    }
    assert yaml.safe_load((folder / "android.yml").read_text()) == {
        "general port": 0,
        "orientation port": 0,
    }
    same = runner.ask(
        aircraft="glider-1",
        profile="easyglider",
        configuration={"load_guard.yml": {"interval": 2}},
    )
    assert same["running"] is True and same["error"] is None
    other = runner.ask(aircraft="glider-1", profile="cub")
    assert other["running"] is True and other["pid"] == answer["pid"]
    assert other["error"] == "glider-1 runs with another configuration, which was not changed"
    nothing_wanted = runner.ask(aircraft="glider-1")
    assert nothing_wanted["error"] is None


@pytest.mark.parametrize(
    ("request_", "error"),
    [
        ({"profile": "ufo"}, "there is no profile ufo on this host"),
        ({"profile": "../blackbox"}, "profile must be 1 to 32"),
        ({"configuration": {"disabled_modules.yml": {"disabled modules": "x"}}}, "may not set"),
        ({"configuration": {"load_guard.yml": {"script": "x"}}}, "may not set 'script'"),
        ({"configuration": {"../runner.yml": {"python": "x"}}}, "may not set"),
        ({"configuration": {"load_guard.yml": {"interval": "/bin/sh"}}}, "without slashes"),
        ({"configuration": {"load_guard.yml": {"interval": ["a"]}}}, "must be a number, a text"),
        ({"aircraft": ".."}, "aircraft must be 1 to 32"),
        ({"aircraft": "a/b"}, "aircraft must be 1 to 32"),
        ({"aircraft": "x" * 33}, "aircraft must be 1 to 32"),
        ({"action": "stop"}, "action must be"),
    ],
)
def test_what_a_request_may_not_ask_is_refused_in_one_sentence(runners, request_, error):
    runner = runners().start()
    answer = runner.ask(**request_)
    assert error in answer["error"] and answer["spawned"] is False
    assert "\n" not in answer["error"]
    assert runner.instances() == []


def test_a_refused_request_leaves_no_instance_behind(runners):
    runner = runners(instances=1).start()
    assert runner.ask(aircraft="a", profile="ufo")["error"]
    assert runner.spawn("b")["spawned"] is True


def test_what_an_instance_learned_is_kept_until_the_profile_changes(runners):
    runner = runners().start()
    runner.write("blackbox/pids.yml", {"p": 1.0})
    runner.write("profiles/cub/pids.yml", {"p": 5.0})
    config = runner.run_folder / "glider-1" / "config" / "pids.yml"
    runner.spawn()
    assert yaml.safe_load(config.read_text()) == {"p": 1.0}
    config.write_text("p: 2.5\n")
    for profile, expected in ((None, 2.5), ("cub", 5.0)):
        os.kill(runner.status()["pid"], signal.SIGTERM)
        wait_until(lambda: not runner.instances(), "it ended")
        wait_until(lambda: runner.status()["error"] is None, "it is forgotten")
        runner.spawn(**({"profile": profile} if profile else {}))
        assert yaml.safe_load(config.read_text()) == {"p": expected}


def test_a_thousand_askers_get_a_thousand_answers(runners):
    runner = runners().start()
    runner.spawn()
    answers = []

    def ask_often():
        talk = Talk(runner.port)
        for _ in range(100):
            answers.append(talk.ask({"aircraft": "glider-1"})["pid"])
        talk.close()

    threads = [threading.Thread(target=ask_often) for _ in range(10)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 1000 and len(set(answers)) == 1


def test_the_answer_to_a_pipelined_heap_comes_in_order(runners):
    runner = runners().start()
    talk = runner.talk()
    names = [f"plane-{number}" for number in range(50)]
    talk.say(
        b"".join(b'{"action": "status", "aircraft": "%s"}\r\n\n' % name.encode() for name in names)
    )
    assert [talk.hear()["instance"] for _ in names] == names
    # An empty line after a request does not make a thesis client.
    assert runner.instances() == []
