"""The scenarios that are shipped, and one flight of each."""

import dataclasses
import io

from tests.support.firmware import build_firmware
from tests.support.tools import need_tool
from up_simulator.scenario.file import read_scenario
from up_simulator.scenario.run import ProgressLine, fly_scenario
from up_simulator.verbs.catalogue import shipped_paths

SCENARIOS = {path.stem: read_scenario(path) for path in shipped_paths()}
REAL = [name for name, each in SCENARIOS.items() if each.is_real]
WITH_DAEMON = [name for name, each in SCENARIOS.items() if each.has_raspilot and name not in REAL]
ALONE = [name for name, each in SCENARIOS.items() if not each.has_raspilot]
LONG_S = 100.0
"""Longer flights use the host build of the same sources: the chip takes twice as long. So do those
of navigation, to which the chip adds nothing."""


def fly(name):
    """Fly a shipped scenario and its control run; return what did not hold."""
    build_firmware()
    scenario, title = SCENARIOS[name], "the firmware on a simulated ATmega328P"
    if scenario.duration_s > LONG_S or scenario.board == "host":
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
