"""The systemd unit of Raspilot, and the program under it."""

import configparser
import os
import re
import shlex
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.tools import need_tool

ROOT = Path(__file__).parents[2]
UNIT = ROOT / "raspilot" / "raspilot.service"
PYTHON = "/opt/raspilot/bin/python"
LIMIT_S = 60.0


def options():
    parser = configparser.ConfigParser(strict=True, allow_no_value=False)
    parser.optionxform = str
    parser.read_string(UNIT.read_text(encoding="utf-8"))
    return parser


def verify(unit):
    verified = subprocess.run(
        [need_tool("systemd-analyze", "systemd"), "verify", str(unit)],
        capture_output=True,
        text=True,
    )
    return verified.returncode, verified.stderr


def unit_with(folder, *changes):
    text = UNIT.read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    unit = folder / UNIT.name
    unit.write_text(text, encoding="utf-8")
    return unit


@pytest.mark.parametrize("commented_out", [(), ("CPUSchedulingPolicy=", "CPUSchedulingPriority=")])
def test_systemd_finds_no_fault_also_in_what_is_commented_out(tmp_path, commented_out):
    changes = [(f"#{key}", key) for key in commented_out]
    # Verification looks at the program, so the unit names the Python that runs here.
    assert verify(unit_with(tmp_path, (PYTHON, sys.executable), *changes)) == (0, "")


def test_flights_have_a_folder_of_the_state_directory():
    assert options()["Service"]["StateDirectory"] == "raspilot"


def test_a_fault_would_be_found(tmp_path):
    unit = unit_with(tmp_path, (PYTHON, sys.executable), ("Type=notify", "Type=notifie"))
    assert verify(unit) != (0, "")


def test_it_is_supervised_and_restarted_for_ever():
    unit = options()
    assert unit["Unit"]["StartLimitIntervalSec"] == "0"
    service = unit["Service"]
    assert service["Type"] == "notify"
    assert service["WatchdogSec"] == "2"
    assert service["Restart"] == "always"
    assert "CPUSchedulingPolicy" not in service


def test_its_command_starts_says_that_it_is_ready_and_alive_and_stops(tmp_path):
    service = options()["Service"]
    program, *arguments = shlex.split(service["ExecStart"])
    assert program == PYTHON and arguments[-2:] == ["--config", "/etc/raspilot"]
    config = tmp_path / "config"
    config.mkdir()
    (config / "android.yml").write_text("general port: 0\norientation port: 0\n")
    (config / "discovery.yml").write_text("port: 0\n")
    period_s = float(service["WatchdogSec"])
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as supervisor:
        supervisor.bind(str(tmp_path / "notify"))
        supervisor.settimeout(LIMIT_S)
        process = subprocess.Popen(
            [sys.executable, *arguments[:-1], str(config)],
            cwd=ROOT,
            env={
                **os.environ,
                "NOTIFY_SOCKET": str(tmp_path / "notify"),
                "WATCHDOG_USEC": str(round(period_s * 1e6)),
                "UP_MODE": "black box",
            },
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            heard = ""
            while not re.search(r"READY=1.*WATCHDOG=1.*WATCHDOG=1", heard, re.DOTALL):
                heard += supervisor.recv(4096).decode() + "\n"
            process.send_signal(signal.SIGTERM)
            log = process.communicate(timeout=LIMIT_S)[1]
        finally:
            if process.poll() is None:
                process.kill()
                process.communicate()
    assert process.returncode == 0, log
