"""Every shipped scenario with real programs holds, flown as a user flies it."""

import subprocess
import sys

import pytest

from tests.simulator.scenarios.shipped import REAL, SCENARIOS
from tests.support.firmware import build_firmware
from up_flightlog.read.flight_log import FlightLog

START_AND_END_S = 90.0


@pytest.mark.slow
@pytest.mark.parametrize("name", REAL)
def test_what_real_programs_fly_holds(name, tmp_path):
    build_firmware()
    command = [sys.executable, "-m", "up_simulator.cli", "fly", name]
    done = subprocess.run(
        [*command, "--no-picture", "--output", str(tmp_path)],
        capture_output=True,
        text=True,
        timeout=SCENARIOS[name].duration_s + START_AND_END_S,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    boxes = sorted((tmp_path / name / "black-box").glob("*.mcap"))
    recorded = [FlightLog.read([path]).topics for path in boxes]
    assert recorded and all(topics["up.orientation.update"] > 20 for topics in recorded)
