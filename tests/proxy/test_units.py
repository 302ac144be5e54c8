"""The systemd unit and the Upstart job."""

import re
from pathlib import Path

from tests.proxy.program import UP_PROXY, Program, accepted
from tests.support.sandbox import service, under, verify
from tests.support.tools import need_tool

FOLDER = Path(__file__).parents[2] / "proxy"
UNIT = "proxy/up-proxy.service"
JOB = FOLDER / "up-proxy.conf"


def test_systemd_finds_no_fault(tmp_path):
    need_tool("systemd-analyze", "systemd")
    verify(UNIT, UP_PROXY, tmp_path)


def test_it_runs_under_the_units_system_call_filter(tmp_path):
    need_tool("systemd-analyze", "systemd")
    with Program(tmp_path, prefix=under(UNIT)) as proxy:
        air, _ = accepted(proxy.airborne_port, "UP1 aircraft=a\n")
        ground, _ = accepted(proxy.ground_port, "UP1 aircraft=a seat=listen\n")
        with air, ground:
            air.say("telemetry\n")
            ground.expect("telemetry")
        assert proxy.end() == 0


def test_it_is_supervised_and_restarted_for_ever():
    assert "\nStartLimitIntervalSec=0\n" in (FOLDER / "up-proxy.service").read_text("utf-8")
    options = service(UNIT)
    assert (options["Type"], options["WatchdogSec"]) == ("notify", "2")
    assert options["Restart"] == "always"


def test_the_upstart_job_runs_the_same_program():
    job = JOB.read_text(encoding="utf-8")
    command = service(UNIT)["ExecStart"]
    assert f"\nexec {command}\n" in job
    assert re.search(r"^respawn$", job, re.MULTILINE)
    assert "expect" not in job  # it stays in the foreground
