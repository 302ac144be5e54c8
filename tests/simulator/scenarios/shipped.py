"""The scenarios that are shipped, and one flight of each."""

import dataclasses
import io

from tests.support.firmware import build_firmware
from tests.support.tools import need_tool
from up_simulator.scenario.file import read_scenario
from up_simulator.scenario.progress import ProgressLine
from up_simulator.scenario.run import fly_scenario
from up_simulator.verbs.catalogue import shipped_paths

SCENARIOS = {path.stem: read_scenario(path) for path in shipped_paths()}
REAL = [name for name, each in SCENARIOS.items() if each.is_real]
WITH_DAEMON = [name for name, each in SCENARIOS.items() if each.has_raspilot and name not in REAL]
ALONE = [name for name, each in SCENARIOS.items() if not each.has_raspilot]
LONG_S = 24.0
"""Longer ones, with their control run, use the host build of the same sources: the chip takes three
times as long. Not those that limit the lateness of the loop, which only the chip has."""


def is_for_host(scenario):
    """Return whether the host build flies it in the tests."""
    total_s = scenario.duration_s * (1 if scenario.control is None else 2)
    is_chips = any(each.signal == "board.loop_late_us" for each in scenario.expect)
    return scenario.board == "host" or (total_s > LONG_S and not is_chips)


def fly(name):
    """Fly a shipped scenario and its control run; return what did not hold."""
    build_firmware()
    scenario, title = SCENARIOS[name], "the firmware on a simulated ATmega328P"
    if is_for_host(scenario):
        need_tool("g++")
        scenario = dataclasses.replace(scenario, board="host")
        title = "the firmware compiled for this computer"
    result = fly_scenario(name, scenario, ProgressLine(io.StringIO(), is_shown=False))
    record = result.record
    assert record.board_title == title
    assert record.failure is None and record.notes == {}, record.failure_log
    return [
        f"{verdict.name}: {verdict.figure} ({verdict.limit}) {verdict.why}".rstrip()
        for verdict in result.verdicts
        if not verdict.is_held
    ]
