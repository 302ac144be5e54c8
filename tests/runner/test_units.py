"""The systemd unit and the Upstart job."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support import sandbox
from tests.support.tools import need_tool

FOLDER = Path(__file__).parents[2] / "runner"
UNIT = "runner/up-runner.service"
JOB = FOLDER / "up-runner.conf"
PROGRAM = Path(sys.executable).with_name("up-runner")


@pytest.fixture
def service():
    return sandbox.service(UNIT)


def test_systemd_finds_no_fault(tmp_path):
    need_tool("systemd-analyze", "systemd")
    sandbox.verify(UNIT, PROGRAM, tmp_path)


def test_it_is_supervised_and_restarted_for_ever(service):
    assert "\nStartLimitIntervalSec=0\n" in (FOLDER / "up-runner.service").read_text("utf-8")
    assert service["Type"] == "notify"
    assert float(service["WatchdogSec"]) > 0
    assert service["Restart"] == "always"


def test_a_restart_of_the_runner_does_not_touch_the_instances(service):
    assert service["KillMode"] == "process"
    assert service["OOMPolicy"] == "continue"
    # Their sockets and records must still be there.
    assert service["RuntimeDirectoryPreserve"] == "yes"
    # A private /tmp or user would be another one after the restart.
    assert "PrivateTmp" not in service and "DynamicUser" not in service


def test_instances_record_their_flights_where_a_service_does(service):
    assert service["StateDirectory"] == "up-runner raspilot"
    assert service["Environment"] == "XDG_STATE_HOME=/var/lib"
    job = JOB.read_text(encoding="utf-8")
    assert "env XDG_STATE_HOME=/var/lib\n" in job and "/var/lib/raspilot\n" in job


def test_the_upstart_job_runs_the_same_program(service):
    job = JOB.read_text(encoding="utf-8")
    program, _, arguments = service["ExecStart"].partition(" ")
    assert f"    {program} -- {arguments}\n" in job
    assert re.search(r"^respawn$", job, re.MULTILINE)
    assert "expect" not in job  # it stays in the foreground


def test_the_upstart_scripts_are_shell():
    scripts = re.findall(r"^pre-start script\n(.*?)^end script", JOB.read_text(), re.DOTALL | re.M)
    assert len(scripts) == 1
    subprocess.run(["sh", "-n"], input=scripts[0], text=True, check=True)
