"""The runner with the real Raspilot and its Android cog."""

import os
import signal
import socket
import time

import pytest

from tests.runner.raspilot_copy import copy_of_raspilot
from tests.runner.runners import can_connect, is_alive, wait_until
from tests.runner.test_watching import restarted
from tests.support.sandbox import service, under
from tests.support.tools import need_tool


@pytest.fixture
def raspilot(runners, short_path):
    """Make a runner of a copy of Raspilot with some cogs registered and nothing else."""

    def make(cogs=("android_cog",), **config):
        return runners(**(copy_of_raspilot(short_path / "application", cogs) | config))

    return make


def test_two_instances_run_and_their_phones_find_them(raspilot):
    runner = raspilot().start()
    answers = [runner.spawn("a"), runner.spawn("b")]
    for answer in answers:
        assert answer["spawned"] is True and set(answer["ports"]) >= {"general", "orientation"}
        assert all(can_connect(port) for port in answer["ports"].values())
    assert len({port for answer in answers for port in answer["ports"].values()}) == 4


def test_the_instance_uses_the_proxy_that_the_answer_names(raspilot):
    with socket.create_server(("127.0.0.1", 0)) as announced:
        announced.settimeout(60)
        port = announced.getsockname()[1]
        proxy = {"host": "127.0.0.1", "airborne port": port}
        runner = raspilot(("android_cog", "mission_control_cog"), proxy=proxy)
        # The instance's own configuration names another one.
        server = {"remote_server": {"url": "127.0.0.2", "port": 1}, "role": "observer"}
        runner.write("blackbox/mission_control.yml", server)
        answer = runner.start().spawn("glider-1")
        assert answer["proxy"] == {"host": "127.0.0.1", "airborne": port, "ground": 3004}
        peer, _ = announced.accept()
        with peer, peer.makefile("rb") as lines:
            assert lines.readline() == b"UP1 aircraft=glider-1 packed=1\n"


def test_it_runs_under_the_units_system_call_filter(raspilot):
    need_tool("systemd-analyze", "systemd")
    units = "runner/up-runner.service", "raspilot/raspilot.service"
    filters = [service(unit)["SystemCallFilter"] for unit in units]
    # An instance inherits the runner's.
    assert filters[0] == filters[1]
    runner = raspilot()
    runner.prefix = under(units[0])
    runner.start()
    instance = runner.spawn()
    assert runner.status()["pid"] == instance["pid"]
    assert runner.terminate() == 0


def test_a_killed_one_comes_back_and_a_new_runner_finds_it(raspilot):
    runner = raspilot().start()
    first = runner.spawn()
    os.kill(first["pid"], signal.SIGKILL)
    second = restarted(runner, first)
    runner.kill()
    runner.start()
    assert runner.spawn()["pid"] == second["pid"]
    assert runner.instances() == [second["pid"]]


def test_it_stops_when_its_phone_has_gone_and_not_before(raspilot):
    runner = raspilot(**{"exit delay": 3}).start()
    answer = runner.spawn()
    phone = runner.talk(answer["ports"]["general"])
    began_s = time.monotonic()
    record = runner.run_folder / "glider-1" / "state.json"
    wait_until(lambda: '"phone": true' in record.read_text(), "the runner knows of the phone")
    while time.monotonic() < began_s + 4:
        phone.say(b"\n")
        time.sleep(0.2)  # longer than the exit delay, with the phone there
    assert runner.status()["pid"] == answer["pid"]
    phone.close()
    assert "exit status 0" in runner.logs("ended", cause="phone_gone")["error"]
    assert not is_alive(answer["pid"]) and not can_connect(answer["ports"]["general"])


def test_a_configuration_mistake_is_the_answers_sentence(raspilot):
    runner = raspilot().start()
    runner.write("blackbox/android.yml", {"general prot": 1})
    answer = runner.ask(aircraft="glider-1")
    assert answer["running"] is False and answer["spawned"] is False
    assert answer["code"] == "start_failed" and "general prot" in answer["error"]
