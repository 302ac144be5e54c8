"""The runner with the real Raspilot and its Android cog."""

import importlib.util
import os
import shutil
import signal
import time
from pathlib import Path

import pytest
import yaml

from tests.runner.runners import can_connect, is_alive, wait_until
from tests.runner.test_watching import restarted
from tests.support.sandbox import service, under
from tests.support.tools import need_tool

ROOT = Path(__file__).parents[2]


@pytest.fixture
def raspilot(runners, short_path):
    """Make a runner of a copy of Raspilot with the Android cog registered and nothing else."""

    def make(**config):
        root = short_path / "application"
        ignored = shutil.ignore_patterns("__pycache__", "external_modules.yml")
        shutil.copytree(ROOT / "raspilot", root / "raspilot", ignore=ignored)
        shutil.copy(ROOT / "main.py", root)
        cog = Path(importlib.util.find_spec("android_cog").origin).parent
        registered = yaml.safe_load((cog / "registered_modules.yml").read_text())
        modules = registered["modules"] if isinstance(registered, dict) else registered
        (root / "raspilot" / "external_modules.yml").write_text(
            yaml.safe_dump({"android_cog": {"source": "manual", "modules": modules}})
        )
        settings = {"application root": str(root), "script path": "main.py", "start limit": 60}
        return runners(**(settings | config))

    return make


def test_two_instances_run_and_their_phones_find_them(raspilot):
    runner = raspilot().start()
    answers = [runner.spawn("a"), runner.spawn("b")]
    for answer in answers:
        assert answer["spawned"] is True and set(answer["ports"]) >= {"general", "orientation"}
        assert all(can_connect(port) for port in answer["ports"].values())
    assert len({port for answer in answers for port in answer["ports"].values()}) == 4


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
    runner = raspilot(**{"exit delay": 4}).start()
    answer = runner.spawn()
    phone = runner.talk(answer["ports"]["general"])
    began_s = time.monotonic()
    record = runner.run_folder / "glider-1" / "state.json"
    wait_until(lambda: '"phone": true' in record.read_text(), "the runner knows of the phone")
    while time.monotonic() < began_s + 6:
        phone.say(b"\n")
        time.sleep(0.2)  # longer than the exit delay, with the phone there
    assert runner.status()["pid"] == answer["pid"]
    phone.close()
    runner.says("its phone was gone for 4 s (ended with exit status 0)")
    assert not is_alive(answer["pid"]) and not can_connect(answer["ports"]["general"])


def test_a_configuration_mistake_is_the_answers_sentence(raspilot):
    runner = raspilot().start()
    runner.write("blackbox/android.yml", {"general prot": 1})
    answer = runner.ask(aircraft="glider-1")
    assert answer["running"] is False and answer["spawned"] is False
    assert "exit status 2" in answer["error"] and "general prot" in answer["error"]
