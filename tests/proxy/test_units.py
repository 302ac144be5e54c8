"""The systemd unit and the Upstart job."""

import configparser
import re
import subprocess
from pathlib import Path

from tests.proxy.program import UP_PROXY, Program, accepted
from tests.support.sandbox import under
from tests.support.tools import need_tool

FOLDER = Path(__file__).parents[2] / "proxy"
UNIT = FOLDER / "up-proxy.service"
JOB = FOLDER / "up-proxy.conf"


def options():
    parser = configparser.ConfigParser(strict=True)
    parser.optionxform = str
    parser.read_string(UNIT.read_text(encoding="utf-8"))
    return parser


def test_systemd_finds_no_fault(tmp_path):
    # Verification looks at the program, so the unit names the one that is installed here.
    text = UNIT.read_text(encoding="utf-8").replace("/opt/raspilot/bin/up-proxy", str(UP_PROXY))
    assert str(UP_PROXY) in text
    unit = tmp_path / UNIT.name
    unit.write_text(text, encoding="utf-8")
    verified = subprocess.run(
        [need_tool("systemd-analyze", "systemd"), "verify", str(unit)],
        capture_output=True,
        text=True,
    )
    assert (verified.returncode, verified.stderr) == (0, "")


def test_it_runs_under_the_units_system_call_filter(tmp_path):
    need_tool("systemd-analyze", "systemd")
    with Program(tmp_path, prefix=under("proxy/up-proxy.service")) as proxy:
        air, _ = accepted(proxy.airborne_port, "UP1 aircraft=a\n")
        ground, _ = accepted(proxy.ground_port, "UP1 aircraft=a seat=listen\n")
        with air, ground:
            air.say("telemetry\n")
            ground.expect("telemetry")
        assert proxy.end() == 0


def test_it_is_supervised_and_restarted_for_ever():
    unit = options()
    assert unit["Unit"]["StartLimitIntervalSec"] == "0"
    service = unit["Service"]
    assert service["Type"] == "notify"
    assert service["WatchdogSec"] == "2"
    assert service["Restart"] == "always"


def test_the_upstart_job_runs_the_same_program():
    job = JOB.read_text(encoding="utf-8")
    command = options()["Service"]["ExecStart"]
    assert f"\nexec {command}\n" in job
    assert re.search(r"^respawn$", job, re.MULTILINE)
    assert "expect" not in job  # it stays in the foreground
