"""A real runner's reactions to instances that end, hang, or lose their phone."""

import os
import signal

import pytest

from tests.runner.runners import can_connect, is_alive, wait_until

ANY_PORTS = {"general port": 0, "orientation port": 0}
QUICK = {"restarts": {"delay": 0.05, "limit": 3}}


def restarted(runner, old):
    """Wait until the instance runs as another process and return its answer."""

    def look():
        answer = runner.status()
        return answer if answer["running"] and answer["pid"] != old["pid"] else None

    return wait_until(look, "it was started again")


def test_a_killed_instance_is_started_again(runner):
    first = runner.spawn()
    os.kill(first["pid"], signal.SIGKILL)
    second = restarted(runner, first)
    assert can_connect(second["ports"]["general"])
    assert runner.instances() == [second["pid"]]
    runner.logs("restarting", cause="exited", delay=0.05)


def test_an_instance_that_fails_too_often_is_given_up(runner):
    answer = runner.spawn()
    for _ in range(3):
        os.kill(answer["pid"], signal.SIGKILL)
        answer = restarted(runner, answer)
    os.kill(answer["pid"], signal.SIGKILL)
    runner.logs("ended", cause="gave_up")
    assert runner.status()["running"] is False and runner.status()["error"] is None
    assert not (runner.run_folder / runner.name / "state.json").exists()
    assert runner.spawn()["spawned"] is True


def test_an_instance_that_cannot_come_back_is_given_up(runner):
    first = runner.spawn()
    runner.write("blackbox/behaviour.yml", {"complaint": "no good"})
    os.kill(first["pid"], signal.SIGKILL)
    assert "no good" in runner.logs("ended", cause="gave_up")["error"]
    assert runner.instances() == []


def test_while_it_waits_for_its_restart_clients_receive_the_reason(runners):
    runner = runners(restarts={"delay": 600, "longest delay": 600}).start()
    first = runner.spawn()
    os.kill(first["pid"], signal.SIGKILL)
    wait_until(lambda: runner.status()["error"], "it waits")
    assert runner.status()["code"] == "waiting"
    answer = runner.ask(aircraft="glider-1")
    assert answer["running"] is False and answer["spawned"] is False
    assert answer["code"] == "restarting"


def test_a_black_box_that_exits_cleanly_stays_ended(runner):
    first = runner.spawn()
    os.kill(first["pid"], signal.SIGTERM)
    runner.logs("ended", cause="exited")
    assert runner.status()["running"] is False
    assert runner.spawn()["spawned"] is True


def test_a_flight_controller_is_restarted_after_any_exit_status(runners):
    runner = runners(mode="flight controller", **QUICK)
    runner.write("android.yml", ANY_PORTS)
    first = runner.start().spawn()
    os.kill(first["pid"], signal.SIGTERM)
    second = restarted(runner, first)
    assert runner.talk(second["ports"]["general"]).order("environ UP_MODE") == "flight controller"


def test_a_hanging_instance_is_killed_and_started_again(runners):
    runner = runners(watchdog=1.0, **QUICK).start()
    first = runner.spawn()
    runner.talk(first["ports"]["general"]).socket.sendall(b"hang\n")
    second = restarted(runner, first)
    assert not is_alive(first["pid"]) and is_alive(second["pid"])
    runner.logs("hung")


def test_a_runner_that_was_stopped_itself_kills_no_instance(runners):
    runner = runners(watchdog=0.5, **QUICK).start()
    first = runner.spawn()
    log = runner.logs_folder / "glider-1.log"
    os.kill(runner.process.pid, signal.SIGSTOP)
    try:
        # Longer than the watchdog, by the instance's own clock.
        talk = runner.talk(first["ports"]["general"])
        for _ in range(30):
            talk.order("nap 0.05")
    finally:
        os.kill(runner.process.pid, signal.SIGCONT)
    assert runner.status()["pid"] == first["pid"]
    talk.order("nap 0.6")
    assert runner.status()["pid"] == first["pid"], log.read_text()


def test_the_exit_delay_begins_when_the_phone_goes(runners):
    runner = runners(**{"exit delay": 1.0}).start()
    first = runner.spawn()
    talk = runner.talk(first["ports"]["general"])
    talk.order("phone 1")
    talk.order("nap 1.5")
    assert runner.status()["pid"] == first["pid"]
    talk.order("phone 0")
    runner.logs("ended", cause="phone_gone")
    assert not is_alive(first["pid"])
    assert not can_connect(first["ports"]["general"])
    assert not can_connect(first["ports"]["orientation"])
    assert runner.status()["running"] is False
    assert "started as glider-1" in runner.log()
    assert runner.spawn()["spawned"] is True


def test_a_process_that_ignores_sigterm_is_killed_and_a_request_waits_for_that(runners):
    runner = runners(**{"exit delay": 1.0}).start()
    runner.write("blackbox/behaviour.yml", {"deaf": True})
    first = runner.spawn()
    talk = runner.talk(first["ports"]["general"])
    talk.order("phone 1")
    helper = int(talk.order("helper"))
    assert is_alive(helper)
    talk.order("phone 0")
    runner.logs("stopping", cause="phone_gone")
    runner.write("blackbox/behaviour.yml", {})
    second = runner.spawn()
    assert second["spawned"] is True and second["pid"] != first["pid"]
    assert "SIGKILL" in runner.logs("ended", cause="phone_gone")["error"]
    assert not is_alive(first["pid"])
    wait_until(lambda: not is_alive(helper), "its helper ended")


@pytest.mark.parametrize("mode", ["flight controller", "auto"])
def test_a_gone_phone_never_stops_a_flight_controller(runners, mode):
    runner = runners(mode=mode, **{"exit delay": 0.2})
    runner.write("android.yml", ANY_PORTS)
    first = runner.start().spawn()
    talk = runner.talk(first["ports"]["general"])
    talk.order("phone 1")
    talk.order("phone 0")
    talk.order("nap 1")
    assert runner.status()["pid"] == first["pid"]


def test_logs_are_bounded_while_the_instance_writes(runners):
    runner = runners(logs={"size": 10_000, "keep": 2}).start()
    first = runner.spawn()
    talk = runner.talk(first["ports"]["general"])
    log = runner.logs_folder / "glider-1.log"
    for number in range(4):
        talk.order("write 12000")
        wait_until(lambda: log.stat().st_size < 10_000, f"log {number} was moved aside")
    older = sorted(path.name for path in runner.logs_folder.iterdir())
    assert older == ["glider-1.log", "glider-1.log.1", "glider-1.log.2"]
    assert (runner.logs_folder / "glider-1.log.1").stat().st_size == 10_000
    talk.order("write 10")
    assert log.read_bytes() == b"x" * 10 + b"\n"
    assert runner.status()["pid"] == first["pid"]


def test_only_the_files_of_the_latest_ended_instances_are_kept(runners):
    runner = runners(**{"kept instances": 2, "exit delay": 0}).start()
    for number in range(5):
        runner.ask(aircraft=f"plane-{number}")
        wait_until(lambda: not runner.instances(), "it ended")
    wait_until(
        lambda: (
            sorted(path.name for path in runner.logs_folder.iterdir())
            == ["plane-3.log", "plane-4.log"]
        ),
        "older ones are removed",
    )
    assert sorted(path.name for path in runner.run_folder.iterdir()) == [
        ".runner.pid",
        "plane-3",
        "plane-4",
    ]
