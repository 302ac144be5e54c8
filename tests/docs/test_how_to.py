"""The examples of the how-to pages work as the pages state."""

from __future__ import annotations

import dataclasses
import importlib
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.ground.aircraft import Aircraft, frame
from tests.ground.web.page import Serve
from tests.proxy.program import Program as Proxy
from tests.support.application import plan_of, write_application
from tests.support.tools import need_browser
from tests.support.virtual_environment import REPOSITORY, VirtualEnvironment
from tests.support.waiting import HANG_S
from tools.schema_definition import Schema
from up.commands.altitude_command import AltitudeCommand
from up.commands.location_command import LocationCommand
from up.commands.origin import INTERNAL, Origin
from up.commands.refusal import CommandRefusedError
from up.commands.roles import Role
from up.loading.application import Application
from up.providers.up_altitude_provider import UpAltitudeProvider
from up.providers.up_location_provider import UpLocationProvider
from up.testing import Bench

_EXAMPLE = re.compile(r"<!-- file: (\S+) -->\n```\w+\n(.*?)```", re.DOTALL)


def examples(page: str) -> dict[str, str]:
    text = (REPOSITORY / "docs/how-to" / page).read_text()
    return dict(_EXAMPLE.findall(text))


def add_lines(setup: Path, page: str) -> None:
    """Add the lines that a page shows as part of a ``setup.py``; packages as far as they go."""
    text = (REPOSITORY / "docs/how-to" / page).read_text()
    (line,) = re.findall(r"<!-- line of \S+ -->\n```\w+\n(.*?)```", text, re.DOTALL)
    shown = setup.read_text()
    shown = shown.replace('"beacon_cog.modules"]', '"beacon_cog.modules", "beacon_cog.cli"]')
    assert shown.endswith(")\n")
    setup.write_text(f"{shown[:-2]}{line})\n")


@pytest.fixture
def plane(tmp_path):
    """Return a function that writes the application ``plane`` of a page."""

    def write(page: str) -> Application:
        return write_application(tmp_path / "plane", examples(page), "plane")

    yield write
    for name in [name for name in sys.modules if name.split(".")[0] == "plane"]:
        del sys.modules[name]


def test_the_instrument_shows_the_modules_value(tmp_path, monkeypatch):
    text = (REPOSITORY / "docs/how-to/module.md").read_text()
    file, script = re.search(r"<!-- script: (\S+) -->\n```js\n(.*?)```", text, re.DOTALL).groups()
    node = need_browser()
    # The three places, in a copy that is served instead.
    copy = tmp_path / "copy" / "up_ground"
    shutil.copytree(REPOSITORY / "ground" / "up_ground", copy)
    static = copy / "web" / "static"
    (static / file).write_text(script)
    index, main = static / "index.html", static / "js" / "main.js"
    place, line = '<p id="ceiling"></p>', f'["ceiling", "./{file.removeprefix("js/")}"],'
    index.write_text(index.read_text().replace("</main>", f"{place}</main>"))
    main.write_text(main.read_text().replace("const PARTS = [", f"const PARTS = [{line}"))
    monkeypatch.setenv("PYTHONPATH", str(copy.parent))
    data = frame(ceiling={"highest_m": 412.4})
    with (
        Proxy(tmp_path / "proxy", "metrics: false\n") as proxy,
        Aircraft(proxy.airborne_port, data=data),
        Serve(tmp_path, proxy.ground_port) as server,
    ):
        program = REPOSITORY / "tests" / "docs" / "instrument_page.mjs"
        done = subprocess.run(
            [node, program, f"http://127.0.0.1:{server.port}/", "ceiling"],
            capture_output=True,
            text=True,
            timeout=HANG_S,
        )
    assert (done.returncode, done.stdout) == (0, "highest 412 m\n"), done.stderr


def test_the_row_of_telemetry_is_valid(tmp_path):
    text = (REPOSITORY / "docs/how-to/module.md").read_text()
    file, row = re.search(r"<!-- row: (\w+) -->\n```yaml\n(.*?)```", text, re.DOTALL).groups()
    shutil.copytree(REPOSITORY / "schema", tmp_path / "schema")
    with (tmp_path / "schema" / f"{file}.yml").open("a", encoding="utf-8") as opened:
        opened.write(row)
    (rule,) = [rule for rule in Schema(tmp_path / "schema").rules if rule["code"] == "ceiling"]
    assert (rule["path"], rule["above"]) == ("ceiling.highest_m", 1000)


def test_the_module_is_shorter_than_15_lines_and_works(plane, tmp_path):
    files = examples("module.md")
    assert len(files["modules/ceiling_module.py"].splitlines()) < 15
    application = plane("module.md")
    plan = plan_of(application)
    assert not plan.problems
    loaded = {module.class_name: type(module) for module in plan.modules}
    bench = Bench(loaded["CeilingModule"], config_folder=tmp_path)
    bench.start()
    for altitude_m in (100.0, 250.0, 30.0):
        bench.up.command_executor.execute_command(AltitudeCommand(altitude_m), INTERNAL)
        bench.advance(0.1)
    bench.up.command_executor.execute_command(AltitudeCommand(900.0, "required"), INTERNAL)
    module = bench.module(loaded["CeilingModule"])
    assert module.telemetry_content == {"ceiling": {"highest_m": 250.0}}
    bench.stop()


def test_the_sensor_is_followed_while_it_sends_and_named_sources_come_first(plane, tmp_path):
    plan = plan_of(plane("module.md"))
    assert not plan.problems
    lidar = next(type(module) for module in plan.modules if module.class_name == "LidarModule")
    phone = Origin("android", Role.SENSOR, 0)

    def fly(folder: Path) -> tuple[str, str]:
        """Return the source while both speak, and after the lidar fell silent."""
        bench = Bench(lidar, UpAltitudeProvider, config_folder=folder)
        bench.start()
        altitude = bench.module(UpAltitudeProvider)
        sources = []
        for silent in (False, True):
            bench.module(lidar).read_m = (lambda: None) if silent else (lambda: 312.5)
            for _ in range(30):
                bench.advance(0.1)
                bench.up.command_executor.execute_command(AltitudeCommand(300.0), phone)
            sources.append(altitude.reading.source)
        bench.stop()
        return sources[0], sources[1]

    assert fly(tmp_path) == ("lidar", "android")
    (tmp_path / "ordered").mkdir()
    (tmp_path / "ordered" / "providers.yml").write_text("altitude: [android, lidar]\n")
    assert fly(tmp_path / "ordered") == ("android", "android")


def test_the_light_follows_the_selected_position_and_shows_its_loss(plane, tmp_path):
    loaded = {type(each).__name__: type(each) for each in plan_of(plane("module.md")).modules}
    light = loaded["PositionLightModule"]
    bench = Bench(light, UpLocationProvider, config_folder=tmp_path)
    bench.start()
    colors = [bench.module(light).color]
    bench.up.command_executor.execute_command(LocationCommand(48.0, 17.0), INTERNAL)
    colors.append(bench.module(light).color)
    for _ in range(2):
        bench.advance(1.6)
        colors.append(bench.module(light).color)
    assert colors == ["red", "green", "green", "red"]
    bench.stop()


def test_the_table_of_sources_names_every_provider_and_its_commands_fields():
    text = (REPOSITORY / "docs/how-to/module.md").read_text()
    rows = re.findall(
        r"^\| (\w+) \| `([\w.]+)` \| `([\w.]+)\.(\w+)` \| (.*) \|$", text, re.MULTILINE
    )
    assert {row[0] for row in rows} == {"location", "altitude", "heading", "orientation", "rx"}
    for _reading, wire_name, module, name, shown in rows:
        command = getattr(importlib.import_module(module), name)
        assert wire_name == command.NAME
        known = [each.name for each in dataclasses.fields(command)]
        named = re.findall(r"`(\w+)(?:=[^`]*)?`", shown)
        ignored = {"distance_from_home_m", "required_bearing_deg"}
        assert named == [each for each in known if each not in ignored]


def test_the_modules_test_passes(plane):
    application = plane("module.md")
    (application.root / "__init__.py").write_text("")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "--import-mode=importlib", "tests"],
        cwd=application.root,
        env={"PYTHONPATH": f"{REPOSITORY}:{application.root.parent}"},
        capture_output=True,
        text=True,
        timeout=HANG_S,
        check=False,
    )
    assert "1 passed" in done.stdout, done.stdout + done.stderr


def test_the_command_is_registered_checked_and_handled(plane, tmp_path):
    plan = plan_of(plane("command.md"))
    assert not plan.problems
    (command,) = plan.commands
    assert command.NAME == "plane.release"
    assert command.from_data({"box": 2}).after_s == 0.0
    with pytest.raises(ValueError, match="box"):
        command.from_data({"box": 5})
    (handler,) = plan.handlers
    handler.run_action(command(box=1))
    with pytest.raises(CommandRefusedError):
        handler.run_action(command(box=4))
    box = next(type(module) for module in plan.modules if module.class_name == "BoxModule")
    bench = Bench(box, config_folder=tmp_path)
    bench.start()
    bench.up.command_executor.execute_command(command(box=3), INTERNAL)
    bench.advance(0.1)
    assert bench.module(box).opened == (3,)
    bench.stop()


def test_the_cog_is_gathered_and_loaded(tmp_path):
    for name, text in examples("cog.md").items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    for folder in ("", "modules", "cli"):
        Path(tmp_path, "beacon_cog/beacon_cog", folder, "__init__.py").write_text("")
    add_lines(tmp_path / "beacon_cog/setup.py", "cog.md")
    (tmp_path / "plane/UpFile").write_text("")
    environment = VirtualEnvironment(tmp_path / "environment")
    environment.up("gather", cwd=tmp_path / "plane")
    assert "BeaconModule" in environment.up("modules", cwd=tmp_path / "plane").stdout
    assert " beacon " in environment.up("--help", cwd=tmp_path).stdout
    assert environment.up("beacon", cwd=tmp_path).stdout == "this is OK-UAV\n"
    assert environment.up("beacon", "--loud", cwd=tmp_path).stdout == "OK-UAV\n"
