"""Checking, listing, exploring, schemas: the verbs that look and do not start."""

import json

import pytest

from tests.support.application import write_application
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
    outcome = up("check")
    assert outcome.status == 2 and "--defaults" in outcome.err
    assert up("check", "--defaults").status == 0
    write_application(application.root, {"config/config.yml": "log level: info\n"})
    outcome = up("check")
    assert (outcome.status, outcome.err) == (0, "")


def test_check_tells_everything_at_once(up, application, tmp_path):
    write_application(
        tmp_path,
        {
            "Cogfile.yml": "gone_cog: {pypi: gone}\nother_cog:\n",
            "config/config.yml": "log levl: info\nmode: sideways\n",
            "config/gauge.yml": "interval_s: 10\n",
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
    outcome = up("check")
    assert outcome.status == 2
    for wanted in (
        f"{tmp_path}/Cogfile.yml:2:1: other_cog: give one of path",
        f"{tmp_path}/config/config.yml:1:1: unknown key",
        "did you mean 'log level'",
        f"{tmp_path}/config/config.yml:2:7: mode: must be one of",
        f"{tmp_path}/config/gauge.yml:1:13: interval_s: must be a number between 0 and 9",
        "the registered cog lost_cog cannot be imported",
        f"{tmp_path}/modules/broken.py:1: syntax",
        "RuntimeError: built",
        f"warning: {tmp_path}/config/old.yml: no module of this application reads this file",
        "warning: disabled_modules.yml: nobody.knows.This does not exist, so it cannot be disabled",
    ):
        assert wanted in outcome.err, (wanted, outcome.err)
    count = sum(not line.startswith("warning") for line in outcome.err.splitlines())
    assert outcome.out == f"{count} mistakes to fix\n"


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
    outcome = up("check", "--mode", "black box")
    assert outcome.status == 2
    assert "User needs Line" in outcome.err and "Other needs Line" in outcome.err


def test_a_wanted_cog_that_is_not_registered_is_a_mistake(up, application, tmp_path):
    (tmp_path / "Cogfile.yml").write_text("lidar_cog: {pypi: raspilot-lidar-cog}\n")
    outcome = up("check")
    assert outcome.status == 2
    assert "lidar_cog is not registered" in outcome.err and up("modules").err


def test_another_configuration_folder(up, application, tmp_path):
    (tmp_path / "other").mkdir()
    (tmp_path / "other/gauge.yml").write_text("interval_s: no\n")
    assert up("check", "--defaults").status == 0
    assert up("check", "--config", "other").status == 2
    outcome = up("check", "--config", "nowhere")
    assert outcome.status == 2 and "nowhere" in outcome.err


def test_modules_in_both_modes(up, application):
    flying = up("modules").out
    assert "mode: auto" in flying
    assert "modules/gauge.py" in flying
    assert "built in" in flying
    box = up("modules", "--mode", "black box").out
    loaded, _, left = box.partition("not loaded:")
    assert "GaugeModule" not in loaded
    assert "GaugeModule  not for the mode 'black box'" in left


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
    assert "tool.yml: no module" in environment.up("check", cwd=plane).stderr
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
