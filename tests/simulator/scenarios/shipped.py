"""The scenarios that are shipped, and one flight of each."""

import dataclasses
import io
import json
import os
import subprocess
import sys

from tests.support.firmware import build_firmware
from tests.support.tools import need_root, need_tool
from up_flightlog.read.flight_log import FlightLog
from up_simulator.scenario.file import read_scenario
from up_simulator.scenario.progress import ProgressLine
from up_simulator.scenario.run import SUMMARY, fly_scenario
from up_simulator.verbs.catalogue import shipped_paths

SCENARIOS = {path.stem: read_scenario(path) for path in shipped_paths()}
REAL = [name for name, each in SCENARIOS.items() if each.is_real]
WITH_BETAFLIGHT = [name for name in REAL if SCENARIOS[name].board == "betaflight"]
"""They have fixed ports: tests/simulator/betaflight/ flies them."""
WITH_DAEMON = [name for name, each in SCENARIOS.items() if each.has_raspilot and name not in REAL]
ALONE = [name for name, each in SCENARIOS.items() if not each.has_raspilot]
START_AND_END_S = 300.0
REAL_TIME = ("chrt", "--rr", "1")
FLIGHTS = 4
"""How often a flight is flown that a busy machine slows."""
LONG_S = 14.0
"""Longer ones use the host build of the same sources: the chip takes three times as long. Not those
that limit the lateness of the loop, which only the chip has."""


def is_for_host(scenario):
    """Return whether the host build flies it in the tests."""
    is_chips = any(each.signal == "board.loop_late_us" for each in scenario.expect)
    return scenario.board == "host" or (scenario.duration_s > LONG_S and not is_chips)


def fly(name, model="auto"):
    """Fly a shipped scenario; return what did not hold.

    Not its control run, which tests the scenario and not the product: ``make scenarios`` flies it.
    """
    build_firmware()
    scenario, title = SCENARIOS[name], "the firmware on a simulated ATmega328P"
    board = scenario.board
    if is_for_host(scenario):
        need_tool("g++")
        board = "host"
        title = "the firmware compiled for this computer"
    scenario = dataclasses.replace(scenario, model=model, board=board, control=None)
    result = fly_scenario(name, scenario, ProgressLine(io.StringIO(), is_shown=False))
    record = result.record
    assert record.board_title == title
    assert record.failure is None and record.notes == {}, record.failure_log
    return [
        f"{verdict.name}: {verdict.figure} ({verdict.limit}) {verdict.why}".rstrip()
        for verdict in result.verdicts
        if not verdict.is_held
    ]


def was_too_slow(summary):
    """Return whether a flight was not in real time; one that left no summary was not flown."""
    return summary.is_file() and "not_real_time" in json.loads(summary.read_text())["notes"]


def fly_real(name, folder, **environment):
    """Fly a scenario with real programs as a user does; what they recorded is whole.

    A flight that a busy machine slowed shows nothing: it is flown again.
    """
    if SCENARIOS[name].through == "two paths":
        need_root()
        need_tool("nft", "nftables")
    command = [sys.executable, "-m", "up_simulator.cli", "fly", name]
    # Before the other tests, where this user may say so.
    if subprocess.run([*REAL_TIME, "true"], capture_output=True, check=False).returncode == 0:
        command[:0] = REAL_TIME
    for _ in range(FLIGHTS):
        done = subprocess.run(
            [*command, "--no-picture", "--output", str(folder)],
            env=os.environ | environment,
            capture_output=True,
            text=True,
            timeout=SCENARIOS[name].duration_s + START_AND_END_S,
        )
        if done.returncode == 0 or not was_too_slow(folder / name / SUMMARY):
            break
    assert done.returncode == 0, done.stdout + done.stderr
    boxes = sorted((folder / name / "black-box").glob("*.mcap"))
    recorded = [FlightLog.read([path]).topics for path in boxes]
    assert recorded and all(topics["up.orientation.update"] > 20 for topics in recorded)
