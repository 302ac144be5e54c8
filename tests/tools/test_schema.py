"""One line in schema/status.yml: a new byte of the status, with an alarm, in every output."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.tools import need_tool

ROOT = Path(__file__).parents[2]
TREES = ("schema", "up", "cogs/arduino_cog", "arduino/raspilot/src", "ground/up_ground",
         "simulator/up_simulator", "android/core/src/org/raspilot/up/ground")  # fmt: skip
LINE = (
    "  - {name: brown_outs, type: u8, about: brown-outs since power-on, row: {label: Brown-outs},"
    " alarm: {above: 2, level: alarm, text: the supply of the board fails,"
    " end: the supply of the board is stable, hold_s: 5}}\n"
)
USER = """
import json, sys
from arduino_cog.commands.arduino_status_command import read_status
from up.commands.board_schema import STATUS
from up.commands.board_status import telemetry_of
from up.flight_log.telemetry_schema import PROPERTIES
from up.protocols.general_message import GeneralMessage
from up_ground.telemetry import NAME, Telemetry
from up_ground.web.event_monitor import EventMonitor
from up_ground.web.event_rules import LinkSnapshot
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.scenario.signals import SIGNALS
from up_simulator.firmware.wire import checked_frame

told = []
monitor = EventMonitor("kite", told.append)
link = LinkSnapshot(True, "", True, True, False)
def see(count, now_s):
    status = read_status(bytes(STATUS.size - 1) + bytes((count,)))
    telemetry = Telemetry()
    arduino = {"brown_outs": telemetry_of(status.data)["brown_outs"]}
    telemetry.update(GeneralMessage(NAME, {"arduino": arduino}), now_s)
    monitor.on_frame(telemetry, link, now_s)
    return status
for now_s, count in ((1, 0), (2, 3), (20, 0), (24, 0), (26, 0)):
    status = see(count, now_s)
tap = LineMonitor()
tap.feed(checked_frame(0, "x", bytes(STATUS.size - 1) + b"\\7"), 0.0)
json.dump({
    "telemetry": telemetry_of(status.data)["brown_outs"],
    "events": [each["code"] for each in told if each["type"] == "event"],
    "alarms": [[a["kind"] for a in each["active"]] for each in told if each["type"] == "alarms"],
    "tap": tap.status.brown_outs,
    "signals": [each for each in SIGNALS if "brown_outs" in each],
    "type": PROPERTIES["arduino"]["properties"]["brown_outs"]["type"],
}, sys.stdout)
"""


def schema(root, *arguments):
    program = [sys.executable, str(ROOT / "tools" / "schema.py"), "--root", str(root), *arguments]
    return subprocess.run(program, capture_output=True, text=True, timeout=60, check=False)


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    root = tmp_path_factory.mktemp("tree")
    for name in TREES:
        ignored = shutil.ignore_patterns("__pycache__", "node_modules", "vendor")
        shutil.copytree(ROOT / name, root / name, ignore=ignored)
    (root / "docs").mkdir()
    shutil.copy(ROOT / "docs" / "protocols.md", root / "docs")
    with (root / "schema" / "status.yml").open("a", encoding="utf-8") as file:
        file.write(LINE)
    assert schema(root, "--check").returncode == 1
    assert schema(root).returncode == 0
    return root


def test_the_tables_of_the_project_are_current():
    result = schema(ROOT, "--check")
    assert (result.returncode, result.stdout) == (0, "")


def test_it_is_in_telemetry_events_alarms_and_scenarios(tree):
    folders = (tree, tree / "cogs/arduino_cog", tree / "ground", tree / "simulator", ROOT)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, folders))}
    result = subprocess.run(
        [sys.executable, "-c", USER], env=environment, cwd=tree, capture_output=True, text=True,
        timeout=120, check=True,
    )  # fmt: skip
    found = json.loads(result.stdout)
    assert found == {
        "telemetry": 0,
        "events": ["brown_outs", "brown_outs_over"],
        "alarms": [["brown_outs"], []],
        "tap": 7,
        "signals": ["board.brown_outs", "ground.arduino.brown_outs"],
        "type": "number",
    }


def test_it_is_in_the_firmware(tree):
    need_tool("g++")
    source = tree / "arduino/raspilot/src/protocol/status.cpp"
    text = source.read_text()
    text = text.replace("}  // namespace raspilot\n", 'static_assert(STATUS_SIZE == 21, "");\n}\n')
    before = "  put_u16(payload + AT_LOOP_US,"
    source.write_text(text.replace(before, f"  payload[AT_BROWN_OUTS] = 0;\n{before}"))
    subprocess.run(
        ["g++", "-std=gnu++11", "-fsyntax-only", str(source)], timeout=120, check=True,
    )  # fmt: skip


def test_it_is_on_the_page(tree):
    need_tool("node")
    script = "import('./board_schema.js').then((m) => console.log(JSON.stringify(m.BOARD_ROWS)))"
    result = subprocess.run(
        ["node", "-e", script], cwd=tree / "ground/up_ground/web/static/js/state",
        capture_output=True, text=True, timeout=60, check=True,
    )  # fmt: skip
    row = json.loads(result.stdout)[-1]
    assert (row["label"], row["path"]) == ("Brown-outs", "arduino.brown_outs")


def test_it_is_in_the_app_and_in_the_documents(tree):
    app = tree / "android/core/src/org/raspilot/up/ground"
    assert "        BROWN_OUTS,\n" in (app / "Alarm.java").read_text()
    table = (app / "BoardSchema.java").read_text()
    assert '"arduino.brown_outs", null, 2' in table and '"", 5000)' not in table
    assert "5000)" in table
    page = (tree / "docs" / "protocols.md").read_text()
    assert "| 20 | u8 | `brown_outs` | brown-outs since power-on |" in page
    assert (
        "| `arduino.brown_outs` above 2 | alarm | `brown_outs` | the supply of the board fails |"
        in page
    )
    assert "| `x` | 78 | 21 |" in page
    assert "`frame_errors`, `brown_outs` |" in page


@pytest.mark.parametrize(
    ("row", "named"),
    [
        ("{name: odd, type: u64}", "odd"),
        ("{name: odd, type: u8, colour: red}", "colour"),
        ("{name: odd, type: u8, alarm: {level: alarm}}", "alarm"),
    ],
)
def test_an_invalid_row_is_named(tmp_path, row, named):
    (tmp_path / "schema").mkdir()
    text = (ROOT / "schema" / "status.yml").read_text()
    (tmp_path / "schema" / "status.yml").write_text(f"{text}  - {row}\n")
    result = schema(tmp_path)
    assert result.returncode == 1
    assert "status.yml: odd" in result.stderr and named in result.stderr
