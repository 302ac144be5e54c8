"""Real programs that cannot fly: one sentence and status 1."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.firmware import build_firmware

LIMIT_S = 120.0
REAL = """\
title: Real
duration_s: 3
sticks: [{at_s: 0, mode: FBW, arm: true, throttle: 0.5}]
raspilot: {runs: real}
ground: {}
events:
  - {at_s: 0.2, name: out, serial: unplugged}
  - {at_s: 0.4, name: in, serial: back}
expect: [{name: a, signal: time_s, above: -1}]
"""
TAKEN_NAME = """
from up_simulator.scenario.real_participants import RealParticipants
plug = RealParticipants.plug_serial
def taken(participants, is_in):
    if is_in:
        (participants._folder / "board").write_text("foreign")
    plug(participants, is_in)
RealParticipants.plug_serial = taken
"""
SLOWED = """
import time
from up_simulator.scenario.flight import ScenarioFlight
step = ScenarioFlight.step
def slow(flight):
    if flight._steps % 100 == 0:
        time.sleep(0.5)
    step(flight)
ScenarioFlight.step = slow
"""
FLY = """
import sys
from up_simulator.cli import main
sys.exit(main(["fly", "real.yml", "--no-picture", "--output", "out"]))
"""


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("real.yml").write_text(REAL)
    build_firmware()


def fly(patch):
    return subprocess.run(
        [sys.executable, "-c", patch + FLY],
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )


def test_a_daemon_that_fails_is_reported_with_its_newest_log_lines():
    module = "serial_cog.modules.serial_provider.SerialProvider"
    config = f"{{disabled_modules.yml: {{disabled modules: [{module}]}}}}"
    Path("real.yml").write_text(REAL.replace("runs: real", f"runs: real, config: {config}"))
    done = fly("")
    assert done.returncode == 1 and "SerialProvider" in done.stdout
    summary = json.loads(Path("out/real/summary.json").read_text())
    assert summary["held"] is False and summary["failure_code"] == "participant_failed"
    assert "not_real_time" not in summary["notes"]


def test_a_serial_line_that_cannot_be_reopened_fails_the_flight():
    done = fly(TAKEN_NAME)
    assert "Traceback" not in done.stderr, done.stderr
    assert done.returncode == 1
    summary = json.loads(Path("out/real/summary.json").read_text())
    assert summary["failure_code"] == "serial_line" and summary["failure"] in done.stdout


def test_a_flight_that_was_not_in_real_time_is_noted():
    done = fly(SLOWED)
    summary = json.loads(Path("out/real/summary.json").read_text())
    assert summary["speed"] < 0.9 and summary["notes"].keys() == {"not_real_time"}
    assert summary["notes"]["not_real_time"] in done.stdout
