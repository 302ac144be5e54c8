"""The scenarios that are shipped, and one flight of each."""

import io

from tests.support.firmware import build_firmware
from up_simulator.scenario.file import read_scenario
from up_simulator.scenario.progress import ProgressLine
from up_simulator.scenario.run import fly_scenario
from up_simulator.verbs.shelf import shipped_paths

SCENARIOS = {path.stem: read_scenario(path) for path in shipped_paths()}
REAL = [name for name, each in SCENARIOS.items() if each.is_real]
WITH_DAEMON = [name for name, each in SCENARIOS.items() if each.has_raspilot and name not in REAL]
ALONE = [name for name, each in SCENARIOS.items() if not each.has_raspilot]


def fly(name):
    """Fly a shipped scenario and its control run; return what did not hold."""
    build_firmware()
    progress = ProgressLine(io.StringIO(), is_shown=False)
    result = fly_scenario(name, SCENARIOS[name], progress)
    record = result.record
    assert record.board_title == "the firmware on a simulated ATmega328P"
    assert record.failure is None and record.notes == [], record.failure_log
    return [
        f"{verdict.name}: {verdict.figure} ({verdict.limit}) {verdict.why}".rstrip()
        for verdict in result.verdicts
        if not verdict.is_held
    ]
