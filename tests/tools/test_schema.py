"""One line of schema/: a new byte of the status, or field of telemetry, in every output."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.tools import need_tool
from tests.support.waiting import HANG_S
from tools.command_tables import forms
from up_ground.catalogue import Catalogue

ROOT = Path(__file__).parents[2]
TREES = ("schema", "up", "cogs/arduino_cog", "cogs/load_guard_cog", "arduino/raspilot/src",
         "ground/up_ground", "flightlog/up_flightlog", "simulator/up_simulator",
         "android/core/src/org/raspilot/up/ground",
         "android/core/src/org/raspilot/up/commands",
         "android/core/src/org/raspilot/up/wire")  # fmt: skip
LINES = {
    "status": (
        "  - {name: brown_outs, type: u8, about: brown-outs since power-on,"
        " row: {label: Brown-outs}, alarm: {above: 2, level: alarm,"
        " text: the supply fails, end: the supply is stable, hold_s: 5, cure: a better BEC}}\n"
    ),
    "telemetry": (
        "  - {name: load.temperature, unit: degC, row: {label: Temperature},"
        " about: of the processor, alarm: {above: 80, back: 5, level: alarm, code: too_hot,"
        " text: the Raspberry Pi is too hot, end: the Raspberry Pi has cooled down,"
        " hold_s: 5, cure: air}}\n"
    ),
}
MEASURED = ('"ram": self.ram,', '"ram": self.ram, "temperature": self.ram,')
USER = """
import json, sys
from pathlib import Path
from load_guard_cog.modules.load_guard import LoadGuard
from arduino_cog.commands.arduino_status_command import read_status
from tests.flightlog.flights import FlightMaker, TelemetryCommand, status as flown
from up.commands.board_schema import STATUS
from up.commands.board_status import telemetry_of
from up.commands.telemetry_schema import PROPERTIES
from up.protocols.general_message import GeneralMessage
from up_flightlog.findings.all_checks import findings
from up_ground.telemetry import NAME, Telemetry
from up_ground.web.event_monitor import EventMonitor
from up_ground.web.event_rules import LinkSnapshot
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.scenario.signals import SIGNALS
from up_simulator.firmware.wire import checked_frame

class Hot(LoadGuard):
    cpu_utilization, in_panic, delay_ms = 5.0, False, 20

guard = Hot()
told = []
monitor = EventMonitor("kite", told.append)
link = LinkSnapshot(True, "", True, True, False)
maker = FlightMaker()
STEPS = ((1, 0, 40), (2, 3, 81), (3, 3, 76), (20, 0, 40), (24, 0, 40), (26, 0, 40))
for now_s, count, degrees in STEPS:
    status = read_status(bytes(STATUS.size - 1) + bytes((count,)))
    guard.ram = degrees
    data = {"load": guard.telemetry_content["load"],
            "arduino": {"brown_outs": telemetry_of(status.data)["brown_outs"]}}
    telemetry = Telemetry()
    telemetry.update(GeneralMessage(NAME, data), now_s)
    monitor.update(telemetry, link, now_s)
    maker.put(now_s, TelemetryCommand(data, now_s))
    maker.put(now_s, flown(brown_outs=count))
tap = LineMonitor()
tap.feed(checked_frame(0, "x", bytes(STATUS.size - 1) + b"\7"), 0.0)
json.dump({
    "telemetry": data,
    "events": [each["code"] for each in told if each["type"] == "event"],
    "alarms": [[a["code"] for a in each["active"]] for each in told if each["type"] == "alarms"],
    "findings": [each.code for each in findings(maker.log(Path.cwd())) if each.code != "log_gap"],
    "tap": tap.status.brown_outs,
    "signals": [each for each in SIGNALS if "brown_outs" in each or "temperature" in each],
    "types": [PROPERTIES["arduino"]["properties"]["brown_outs"]["type"],
              PROPERTIES["load"]["properties"]["temperature"]["x-unit"]],
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
    for page in ("protocols.md", "troubleshooting.md"):
        shutil.copy(ROOT / "docs" / page, root / "docs")
    for name, line in LINES.items():
        with (root / "schema" / f"{name}.yml").open("a", encoding="utf-8") as file:
            file.write(line)
    module = root / "cogs/load_guard_cog/load_guard_cog/modules/load_guard.py"
    text = module.read_text(encoding="utf-8")
    assert MEASURED[0] in text
    module.write_text(text.replace(*MEASURED), encoding="utf-8")
    assert schema(root, "--check").returncode == 1
    assert schema(root).returncode == 0
    return root


@pytest.mark.parametrize("seed", ["1", "2"])
def test_the_tables_of_the_project_are_current_and_the_same_each_time(seed, monkeypatch):
    monkeypatch.setenv("PYTHONHASHSEED", seed)
    result = schema(ROOT, "--check")
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")


def test_forms_without_the_commands_of_a_broken_cog_are_not_written():
    with pytest.raises(ValueError, match="broken_cog"):
        forms(Catalogue([], ["the Commands of broken_cog are left out"]))


def test_each_command_has_a_json_schema(tmp_path):
    assert schema(ROOT, "--json", str(tmp_path)).returncode == 0
    gains = json.loads((tmp_path / "arduino.pids.tunings.json").read_text())
    assert gains["properties"]["request"]["type"] == "boolean"
    telemetry = json.loads((tmp_path / "up.telemetry.update.json").read_text())
    assert telemetry["properties"]["load"]["properties"]["cpu"]["x-unit"] == "%"


def test_they_are_in_telemetry_events_alarms_findings_and_scenarios(tree):
    cogs = [tree / f"cogs/{name}_cog" for name in ("arduino", "load_guard")]
    rooms = [tree / name for name in ("ground", "flightlog", "simulator")]
    paths = os.pathsep.join(map(str, (tree, *cogs, *rooms, ROOT)))
    result = subprocess.run(
        [sys.executable, "-c", USER], env={**os.environ, "PYTHONPATH": paths}, cwd=tree,
        capture_output=True, text=True, timeout=HANG_S, check=True,
    )  # fmt: skip
    found = json.loads(result.stdout)
    load = {"cpu": 5.0, "ram": 40, "temperature": 40, "panic": False, "delay_ms": 20}
    assert found == {
        "telemetry": {"arduino": {"brown_outs": 0}, "load": load},
        "events": ["brown_outs", "too_hot", "brown_outs_over", "too_hot_over"],
        "alarms": [["brown_outs", "too_hot"], []],
        "findings": ["brown_outs", "too_hot"],
        "tap": 7,
        "signals": ["board.brown_outs", "ground.arduino.brown_outs", "ground.load.temperature"],
        "types": ["number", "degC"],
    }


def test_it_is_in_the_firmware(tree):
    need_tool("g++")
    source = tree / "arduino/raspilot/src/protocol/status.cpp"
    text = source.read_text()
    text = text.replace("}  // namespace raspilot\n", 'static_assert(STATUS_SIZE == 24, "");\n}\n')
    before = "  Link::Frame::u16(autopilot.meter.period_us());"
    field = '  static_assert(AT_BROWN_OUTS + 1 == STATUS_SIZE, "");\n  Link::Frame::u8(0);\n'
    source.write_text(text.replace(before, field + before))
    subprocess.run(
        ["g++", "-std=gnu++11", "-fsyntax-only", str(source)], timeout=HANG_S, check=True,
    )  # fmt: skip


def test_they_are_on_the_page(tree):
    need_tool("node")
    script = "import('./schema.js').then((m) => console.log(JSON.stringify(m.BOARD_ROWS)))"
    result = subprocess.run(
        ["node", "-e", script], cwd=tree / "ground/up_ground/web/static/js/state",
        capture_output=True, text=True, timeout=60, check=True,
    )  # fmt: skip
    rows = {each["path"]: each["label"] for each in json.loads(result.stdout)}
    assert rows["arduino.brown_outs"] == "Brown-outs"
    assert rows["load.temperature"] == "Temperature"


def test_they_are_in_the_app_and_in_the_documents(tree):
    app = tree / "android/core/src/org/raspilot/up/ground"
    table = (app / "TelemetrySchema.java").read_text()
    for path, kind in (("arduino.brown_outs", "brown_outs"), ("load.temperature", "temperature")):
        assert f'"path", "{path}"' in table
        assert f'HOLDS_MS.put("{kind}", 5000L);' in table
    assert 'put(UNITS, "degC", "load.temperature");' in table
    page = (tree / "docs" / "protocols.md").read_text()
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in page.splitlines()]
    heads = [row[:3] for row in rows]
    assert ["23", "u8", "`brown_outs`"] in heads
    assert ["`load.temperature`", "degC", ""] in heads
    codes = {row[3]: row[0] for row in rows if len(row) == 6}
    assert codes["`brown_outs`"] == "`arduino.brown_outs` above 2"
    assert codes["`too_hot`"] == "`load.temperature` above 80"
    assert ["`x`", "78", "24"] in heads
    cures = (tree / "docs" / "troubleshooting.md").read_text()
    assert "`brown_outs` | a better BEC |" in cures


@pytest.mark.parametrize(
    ("file", "row", "named"),
    [
        ("status", "{name: odd, type: u64}", "odd"),
        ("status", "{name: odd, type: u8, colour: red}", "colour"),
        ("status", "{name: odd, type: u8, alarm: {level: alarm}}", "alarm"),
        ("status", "{name: odd, type: u8, alarm: {above: 2}}", "cure"),
        ("telemetry", "{name: odd, type: u8}", "odd"),
        ("telemetry", "{name: odd, alarm: {above: 1, below: 2}}", "alarm"),
        ("telemetry", "{name: odd, reading: mood}", "mood"),
    ],
)
def test_an_invalid_row_is_named(tmp_path, file, row, named):
    shutil.copytree(ROOT / "schema", tmp_path / "schema")
    with (tmp_path / "schema" / f"{file}.yml").open("a", encoding="utf-8") as opened:
        opened.write(f"  - {row}\n")
    result = schema(tmp_path)
    assert result.returncode == 1
    assert f"{file}.yml: odd" in result.stderr and named in result.stderr
