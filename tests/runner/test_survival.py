"""A runner that ends or dies, and the one that comes after it."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

from tests.runner.runners import is_alive, same_instance, wait_until
from tests.runner.test_watching import ANY_PORTS, QUICK, restarted


@pytest.mark.parametrize("end", ["kill", "terminate"])
def test_instances_survive_their_runner_and_are_taken_over(runners, end):
    runner = runners(**QUICK).start()
    before = [runner.spawn("a"), runner.spawn("b")]
    getattr(runner, end)()
    assert all(is_alive(answer["pid"]) for answer in before)
    runner.start()
    for answer in before:
        now = runner.ask(aircraft=answer["instance"])
        assert same_instance(now, answer)
    assert sorted(runner.instances()) == sorted(answer["pid"] for answer in before)


def test_a_taken_over_instance_is_watched_as_any_other(runners):
    runner = runners(**QUICK).start()
    first = runner.spawn()
    runner.kill()
    runner.start()
    os.kill(first["pid"], signal.SIGKILL)
    second = restarted(runner, first)
    runner.logs("restarting", cause="exited")
    runner.kill()
    runner.start()
    talk = runner.talk(second["ports"]["general"])
    talk.order("phone 1")
    talk.socket.sendall(b"hang\n")
    restarted(runner, second)
    runner.logs("hung")


def test_an_instance_that_ended_while_no_runner_watched_is_started_again(runners):
    runner = runners(**QUICK).start()
    first = runner.spawn(configuration={"load_guard.yml": {"interval": 3}})
    runner.kill()
    os.kill(first["pid"], signal.SIGKILL)
    wait_until(lambda: not runner.instances(), "it ended")
    runner.start()
    second = restarted(runner, first)
    config = runner.run_folder / "glider-1" / "config" / "load_guard.yml"
    assert "interval: 3" in config.read_text()
    assert runner.instances() == [second["pid"]]


def test_an_instance_that_exited_cleanly_is_not_restarted(runners):
    runner = runners(**QUICK).start()
    first = runner.spawn()
    os.kill(first["pid"], signal.SIGTERM)
    runner.logs("ended", cause="exited")
    record = runner.run_folder / "glider-1" / "state.json"
    wait_until(lambda: not record.exists(), "it is forgotten")
    runner.kill()
    runner.start()
    assert runner.status()["error"] is None and runner.instances() == []


def test_the_phones_absence_is_known_to_the_next_runner(runners):
    runner = runners(**{"exit delay": 1.0}).start()
    first = runner.spawn()
    runner.talk(first["ports"]["general"]).order("phone 1")
    record = runner.run_folder / "glider-1" / "state.json"
    wait_until(lambda: json.loads(record.read_text())["phone"] is True, "it is written down")
    runner.kill()
    runner.start()
    talk = runner.talk(first["ports"]["general"])
    talk.order("nap 1.5")
    assert runner.status()["pid"] == first["pid"]
    talk.order("phone 0")
    runner.logs("ended", cause="phone_gone")


def test_a_starting_instance_is_taken_over(runners):
    runner = runners(**QUICK).start()
    gate = runner.close_gate()
    runner.talk().say({"aircraft": "glider-1"})
    (pid,) = wait_until(runner.instances, "it starts")
    runner.kill()
    runner.start()
    assert runner.status()["code"] == "starting"
    gate.touch()
    answer = runner.ask(aircraft="glider-1")
    assert answer["pid"] == pid and answer["spawned"] is False and answer["ports"]
    assert runner.instances() == [pid]


@pytest.mark.parametrize("damage", ["{", None])
def test_without_a_saved_state_no_process_is_left_alone(runners, damage):
    runner = runners(**QUICK, **{"start limit": 1.0}).start()
    first = runner.spawn()
    runner.kill()
    record = runner.run_folder / "glider-1" / "state.json"
    record.unlink() if damage is None else record.write_text(damage)
    runner.start()
    # It never reports ready: it is killed when its watchdog messages stop.
    wait_until(lambda: not is_alive(first["pid"]), "the process without a record ended")
    wait_until(lambda: runner.status()["error"] is None, "it is forgotten")
    second = runner.spawn()
    assert second["spawned"] is True
    assert runner.instances() == [second["pid"]]


def test_a_reused_process_number_is_not_adopted(runners):
    runner = runners(**QUICK).start()
    first = runner.spawn()
    runner.kill()
    os.kill(first["pid"], signal.SIGKILL)
    wait_until(lambda: not runner.instances(), "it ended")
    stranger = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(3600)"])
    try:
        record = runner.run_folder / "glider-1" / "state.json"
        state = json.loads(record.read_text())
        state["process"][0] = stranger.pid
        record.write_text(json.dumps(state))
        runner.start()
        second = restarted(runner, first)
        assert second["pid"] != stranger.pid and stranger.poll() is None
        runner.terminate()
        assert stranger.poll() is None
    finally:
        stranger.kill()
        stranger.wait()


def test_killed_at_any_moment_of_a_start_it_starts_nothing_twice(runners):
    runner = runners(**QUICK, **{"start limit": 2.0})
    for delay_s in (0.0, 0.002, 0.004, 0.008, 0.016, 0.032, 0.064):
        runner.start()
        runner.talk().say({"aircraft": "glider-1"})
        time.sleep(delay_s)  # no wait for luck: any moment must do
        runner.kill()
        runner.start()
        answer = runner.ask(aircraft="glider-1")
        if not answer["running"]:
            # The runner died before the process could report ready.
            wait_until(lambda: runner.ask(aircraft="glider-1")["running"], "it runs")
        assert len(runner.instances()) == 1
        runner.terminate()


def test_under_a_service_manager_the_instances_survive_the_runner(runners):
    runner = runners().start()
    first = runner.spawn()
    assert runner.terminate() == 0
    assert "leaving_instances" in [fields.get("code") for fields in runner.events()]
    assert is_alive(first["pid"])


def test_a_runner_started_by_hand_stops_its_instances(runners):
    runner = runners().start(under_systemd=False)
    first = runner.spawn()
    assert runner.terminate() == 0
    assert not is_alive(first["pid"])
    runner.start(under_systemd=False)
    assert runner.status()["error"] is None


def test_stop_instances_on_exit_decides_first(runners):
    runner = runners(**{"stop instances on exit": True}).start()
    runner.write("blackbox/behaviour.yml", {"deaf": True})
    first = runner.spawn()
    assert runner.terminate() == 0
    assert not is_alive(first["pid"])


def test_a_second_signal_does_not_wait(runners):
    runner = runners(**{"stop instances on exit": True}).start()
    runner.write("blackbox/behaviour.yml", {"deaf": True})
    runner.spawn()
    runner.process.send_signal(signal.SIGINT)
    runner.logs("stopping_instances")
    runner.process.send_signal(signal.SIGINT)
    assert runner.wait() == 128 + signal.SIGINT


def test_a_second_runner_on_the_same_folder_is_refused(runners):
    runner = runners().start()
    first = runner.spawn()
    second = runners(**{"run folder": str(runner.run_folder)}).launch()
    assert second.wait() == 1
    last = second.printed.splitlines()[-1]
    assert f"process {runner.process.pid}" in last and str(runner.run_folder) in last
    assert runner.status()["pid"] == first["pid"]


def test_an_aircraft_can_be_started_with_the_runner(runners):
    runner = runners(
        mode="flight controller",
        autostart={"aircraft": "glider-1", "profile": "cub"},
        **QUICK,
    )
    runner.write("android.yml", ANY_PORTS)
    runner.write("profiles/cub/load_guard.yml", {"interval": 4})
    runner.start()
    answer = runner.ask(aircraft="glider-1")
    assert answer["running"] is True and answer["spawned"] is False
    folder = runner.run_folder / "glider-1" / "config"
    assert (folder / "load_guard.yml").read_text() == "interval: 4\n"
    assert (folder / "android.yml").read_text() == (
        runner.config_folder / "android.yml"
    ).read_text()
    assert not (folder / "runner.yml").exists()


def test_an_aircraft_started_with_the_runner_is_retried_without_limit(runners):
    runner = runners(
        mode="flight controller",
        autostart={"aircraft": "glider-1"},
        restarts={"delay": 0.01, "longest delay": 0.02, "limit": 1},
    )
    runner.write("behaviour.yml", {"complaint": "no serial port"})
    runner.write("android.yml", ANY_PORTS)
    runner.start()
    log = runner.logs_folder / "glider-1.log"
    wait_until(lambda: log.exists() and log.read_text().count("no serial port") > 4, "it is tried")
    runner.write("behaviour.yml", {})
    wait_until(lambda: runner.status()["running"], "it runs once it can")
