"""Checking, listing, exploring, schemas: the verbs that look and do not start."""

import json
from pathlib import Path

import pytest

from tests.support.application import write_application
from tests.support.program_output import fields_of
from tests.support.virtual_environment import REPOSITORY, VirtualEnvironment

MODULE = (
    "from dataclasses import dataclass\n"
    "from up.base_module import BaseModule\n"
    "from up.config import ConfigFile, key\n"
    "from up.mode import WITH_BOARD\n"
    "@dataclass(frozen=True, slots=True)\n"
    "class GaugeConfig:\n"
    '    """The gauge."""\n'
    '    interval_s: float = key(1.0, "Time.", minimum=0, maximum=9)\n'
    "class GaugeModule(BaseModule):\n"
    '    CONFIG = ConfigFile("gauge.yml", GaugeConfig)\n'
    "    MODES = WITH_BOARD\n"
)


@pytest.fixture
def application(tmp_path):
    return write_application(tmp_path, {"modules/gauge.py": MODULE})


def test_check_of_what_is_in_order(up, application):
    outcome = up("check", as_json=True)
    assert outcome.status == 2 and outcome.problem["code"] == "no_configuration"
    assert up("check", "--defaults").status == 0
    write_application(application.root, {"config/config.yml": "log level: info\n"})
    outcome = up("check", as_json=True)
    assert (outcome.status, outcome.codes) == (0, ["check_passed"])


def test_check_tells_everything_at_once(up, application, tmp_path):
    write_application(
        tmp_path,
        {
            "Cogfile.yml": "gone_cog: {pypi: gone}\nother_cog:\n",
            "config/config.yml": "log levl: info\nmode: sideways\nlog file: /dev/null/up.jsonl\n",
            "config/gauge.yml": "interval_s: 10\n",
            "config/pids.yml": "navigation: {}\n",
            "modules/pids.py": (
                "from up import Module\nfrom up.flight_controller.pids_file import PIDS\n"
                "class Pids(Module):\n    CONFIG = PIDS\n"
            ),
            "config/disabled_modules.yml": "disabled modules:\n  - nobody.knows.This\n",
            "config/old.yml": "a: 1\n",
            "external_modules.yml": (
                "lost_cog:\n  modules:\n    - {class_name: A, prefix: lost_cog.modules.a}\n"
            ),
            "modules/broken.py": "x = = 1\n",
            "modules/raises.py": MODULE.replace("Gauge", "Raises")
            + "    def __init__(self): raise RuntimeError('built')\n",
        },
        application.package,
    )
    outcome = up("check", as_json=True)
    assert outcome.status == 2
    found = {
        (each["code"], Path(each.get("file", "")).name, each.get("line"))
        for each in fields_of(outcome.err)
    }
    assert found == {
        ("source_unclear", "Cogfile.yml", 2),
        ("unknown_key", "config.yml", 1),
        ("unknown_choice", "config.yml", 2),
        ("out_of_range", "gauge.yml", 1),
        ("cog_import_failed", "", None),
        ("syntax_error", "broken.py", 1),
        ("build_failed", "raises.py", 12),
        ("key_removed", "pids.yml", 1),
        ("file_unused", "old.yml", None),
        ("module_unknown", "disabled_modules.yml", None),
    }
    mistakes = [json.loads(line)["level"] for line in outcome.err.splitlines()].count("error")
    assert fields_of(outcome.out) == [{"code": "check_failed", "count": mistakes}]
    text = up("check").err
    assert "warning: " in text and f"{tmp_path}/config/config.yml:1:1: " in text


@pytest.mark.parametrize("place", ["/dev/null/up.jsonl", "."])
def test_check_warns_of_a_log_file_that_a_start_could_not_write(up, tmp_path, place):
    write_application(tmp_path, {"config/config.yml": f"log file: {place}\n"})
    outcome = up("check", as_json=True)
    assert (outcome.status, outcome.problem["code"]) == (0, "log_file_unwritable")
    assert outcome.problem["value"] == place


def test_check_creates_nothing_for_a_log_file_that_a_start_would_create(up, tmp_path):
    write_application(tmp_path, {"config/config.yml": "log file: logs/new/up.jsonl\n"})
    assert up("check", as_json=True).codes == ["check_passed"]
    assert not (tmp_path / "logs").exists()


def test_check_of_the_module_graph(up, tmp_path):
    classes = (
        "from up.base_module import BaseModule\nfrom up.needs import needs\n"
        "from up.mode import WITH_BOARD\n"
        "class Line(BaseModule):\n    MODES = WITH_BOARD\n"
        "class User(BaseModule):\n    line = needs(Line)\n"
        "class Other(BaseModule):\n    line = needs(Line)\n"
    )
    write_application(tmp_path, {"modules/all.py": classes})
    assert up("check", "--defaults").status == 0
    outcome = up("check", "--defaults", "--mode", "black box", as_json=True)
    assert outcome.codes == ["need_missing", "need_missing", "check_failed"]


FLIGHT_MODE = (
    "from up import FlightMode\n"
    "class {cls}(FlightMode):\n    NAME = {name!r}\n    FALLBACK = {fallback!r}\n"
)
MANAGER = (
    "from up import Module\nfrom up.flight_modes.navigation_file import NAVIGATION\n"
    "class Manager(Module):\n    CONFIG = NAVIGATION\n"
)


def test_flight_modes_are_listed_by_their_names(up, tmp_path):
    mode = FLIGHT_MODE.format(cls="Eight", name="EIGHT", fallback="")
    files = {"flight_modes/eight.py": mode, "flight_controller/manager.py": MANAGER}
    files["config/navigation.yml"] = "auto_mode: EIGHT\n"
    write_application(tmp_path, files)
    assert up("check", "--defaults").status == 0
    assert "EIGHT" in up("modules").out
    modules = json.loads(up("modules", "--json").out)["modules"]
    assert [each["flight_mode"] for each in modules if "flight_mode" in each] == ["EIGHT"]


@pytest.mark.parametrize(
    ("modes", "auto", "code"),
    [
        ([("EIGHT", ""), ("EIGHT", "")], "EIGHT", "flight_mode_invalid"),
        ([("EIGHT", "CRICLE")], "EIGHT", "flight_mode_invalid"),
        ([("Eight", "")], "FBW", "flight_mode_invalid"),
        ([("EIGHT", "FBW")], "EIGTH", "flight_mode_unknown"),
    ],
)
def test_check_of_flight_modes(up, tmp_path, modes, auto, code):
    files = {"config/navigation.yml": f"auto_mode: {auto}\n", "flight_controller/m.py": MANAGER}
    for number, (name, fallback) in enumerate(modes):
        mode = FLIGHT_MODE.format(cls=f"Mode{number}", name=name, fallback=fallback)
        files[f"flight_modes/mode_{number}.py"] = mode
    write_application(tmp_path, files)
    outcome = up("check", as_json=True)
    assert (outcome.status, outcome.codes) == (2, [code, "check_failed"])


def test_a_wanted_cog_that_is_not_registered_is_a_mistake(up, application, tmp_path):
    (tmp_path / "Cogfile.yml").write_text("lidar_cog: {pypi: raspilot-lidar-cog}\n")
    outcome = up("check", "--defaults", as_json=True)
    assert (outcome.status, outcome.problem["code"]) == (2, "not_registered")
    assert outcome.problem["cog"] == "lidar_cog" and up("modules").err


def test_another_configuration_folder(up, application, tmp_path):
    (tmp_path / "other").mkdir()
    (tmp_path / "other/gauge.yml").write_text("interval_s: no\n")
    assert up("check", "--defaults").status == 0
    assert up("check", "--config", "other").status == 2
    outcome = up("check", "--config", "nowhere", as_json=True)
    assert (outcome.status, outcome.problem["code"]) == (2, "folder_missing")


def test_modules_in_both_modes(up, application):
    flying = up("modules").out
    assert "mode: auto" in flying
    assert "modules/gauge.py" in flying
    assert "built in" in flying
    box = up("modules", "--mode", "black box").out
    loaded, _, left = box.partition("not loaded:")
    assert "GaugeModule" not in loaded
    assert "GaugeModule" in left
    document = json.loads(up("modules", "--json").out)
    assert document["mode"] == "auto"
    assert any(each["path"].endswith("modules.gauge.GaugeModule") for each in document["modules"])
    assert json.loads(up("modules", as_json=True).out) == document


def test_the_mode_of_the_environment(up, application, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def in_mode(word: str) -> object:
        with monkeypatch.context() as patch:
            patch.setenv("UP_MODE", word)
            from up.cli.main import main

            return main(["modules"])

    assert in_mode("Black Box") == 0
    assert in_mode("sideways") == 2


def test_schemas_of_every_file(up, application, tmp_path):
    outcome = up("schemas", "out/schemas")
    assert outcome.status == 0
    gauge = json.loads((tmp_path / "out/schemas/gauge.schema.json").read_text())
    assert gauge["properties"]["interval_s"]["maximum"] == 9
    for name in ("config", "disabled_modules", "UpFile"):
        assert (tmp_path / f"out/schemas/{name}.schema.json").exists()


def test_files_of_other_programs_are_known_by_their_entry_points(tmp_path):
    write_application(tmp_path / "plane", {"config/tool.yml": "port: 1\n"}, "plane")
    tool = tmp_path / "tool"
    (tool / "ground_tool").mkdir(parents=True)
    (tool / "ground_tool/__init__.py").write_text(
        "from dataclasses import dataclass\n"
        "from up.config import ConfigFile, key\n"
        "@dataclass(frozen=True, slots=True)\n"
        "class ToolConfig:\n"
        '    port: int = key(1, "Port.", minimum=1)\n'
        'TOOL = ConfigFile("tool.yml", ToolConfig)\n'
    )
    (tool / "setup.py").write_text(
        "from setuptools import setup\n"
        "setup(name='ground-tool', version='1', packages=['ground_tool'],\n"
        "      entry_points={'up.config_files': ['tool = ground_tool:TOOL']})\n"
    )
    environment = VirtualEnvironment(tmp_path / "environment")
    plane = tmp_path / "plane"
    (plane / "config/config.yml").write_text("log level: info\n")
    assert "tool.yml" in environment.up("check", cwd=plane).stderr
    install = ("install", "--quiet", "--no-deps", "--no-build-isolation", "--use-pep517", str(tool))
    environment.run("-m", "pip", *install, cwd=tmp_path)
    assert "tool.yml" not in environment.up("check", cwd=plane).stderr
    (plane / "config/tool.yml").write_text("port: 0\n")
    assert "tool.yml:1:7: port:" in environment.up("check", cwd=plane, status=2).stderr
    environment.up("schemas", "out", cwd=plane)
    assert (plane / "out/tool.schema.json").exists()


def test_explore_in_the_repositorys_root_is_about_raspilot(up):
    outcome = up("explore", cwd=REPOSITORY)
    assert outcome.status == 0
    assert all(line.startswith("raspilot.") for line in outcome.out.splitlines())


def test_explore_lists_and_writes(up, tmp_path):
    up("create", "cog", "-n", "Sonar")
    cog = tmp_path / "sonar_cog"
    up("create", "module", "-n", "Depth", cwd=cog)
    manifest = cog / "sonar_cog/registered_modules.yml"
    before = manifest.read_text()
    listed = up("explore", cwd=cog).out.splitlines()
    assert listed == [
        "sonar_cog.modules.depth_module.DepthModule",
        "sonar_cog.modules.sonar_module.SonarModule",
    ]
    rows = json.loads(up("explore", "--json", cwd=cog).out)
    assert [each["class_name"] for each in rows] == ["DepthModule", "SonarModule"]
    assert manifest.read_text() == before
    assert up("e", "-w", cwd=cog / "sonar_cog").status == 0
    assert "DepthModule" in manifest.read_text()
    (cog / "sonar_cog/modules/broken.py").write_text("x = = 1\n")
    outcome = up("explore", "-w", cwd=cog)
    assert outcome.status == 1 and "broken.py:1: syntax" in outcome.err
    assert up("explore", "-t", "recorders", cwd=cog).status == 0


def test_raspilot_itself_is_looked_at_from_its_folder_and_from_the_root(up):
    for place in (REPOSITORY, REPOSITORY / "raspilot", REPOSITORY / "raspilot/modules"):
        outcome = up("modules", cwd=place)
        assert "up.telemetry_controller.TelemetryController" in outcome.out, outcome.err
