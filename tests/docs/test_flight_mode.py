"""The flight modes and the controller of docs/how-to/flight-mode.md fly."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

from tests.docs.flying import copy_of_the_tree, files_of, flying, lines_of
from tests.raspilot.flight_controller_rig import FBW_MODE
from tests.raspilot.flight_controller_rig import Rig as ManagerRig
from tests.support.application import importable, plan_of, write_application
from tests.support.virtual_environment import REPOSITORY
from tests.support.waiting import HANG_S
from up.commands.flight_state_command import FlightModeCommand, FlightStateCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.output_command import OutputCommand, SetpointCommand
from up.commands.roles import Role
from up.commands.rx_command import RXCommand
from up.flight_modes.flight_mode import FlightMode
from up.providers.base_rx_provider import UpRXProvider
from up.providers.up_orientation_provider import UpOrientationProvider
from up.testing import Bench

PAGE = "how-to/flight-mode.md"
BOARD = Origin("arduino", Role.BOARD, priority=10)


def shown(marker):
    """Return the file that the page shows below this marker."""
    text = (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")
    return re.search(rf"<!-- {marker} -->\n```\w+\n(.*?)```", text, re.DOTALL)[1]


@pytest.fixture
def load(tmp_path):
    """Load an application of files of the page, with the cog; return its modules' classes."""
    packages = []

    def load(files):
        for name in ("flight_modes/level.py", "registered_modules.yml"):
            path = tmp_path / "cogs" / "level_cog" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(shown(f"file: cog: level_cog/{name}"))
        lines = shown("file: cog: level_cog/registered_modules.yml").splitlines(keepends=True)
        registered = "level_cog:\n" + "".join(f"  {line}" for line in lines)
        application = write_application(
            tmp_path / "plane", {"external_modules.yml": registered, **files}
        )
        packages.append(application.package)
        plan = plan_of(application)
        assert not plan.problems
        return {module.class_name: type(module) for module in plan.modules}

    with importable(tmp_path / "cogs", "level_cog"):
        yield load
    for name in [name for name in sys.modules if name.split(".")[0] in packages]:
        del sys.modules[name]


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """A copy of the tree with the flight mode, its test and its scenario."""
    tree = copy_of_the_tree(tmp_path_factory.mktemp("flight_mode") / "tree")
    for name, text in files_of(PAGE).items():
        (tree / "raspilot" / name).write_text(text)
    (tree / "tests").mkdir()
    (tree / "tests" / "test_eight.py").write_text(shown("test: tests/test_eight.py"))
    (tree / "eight.yml").write_text(shown("scenario: eight.yml"))
    return tree


def run(tree, *arguments):
    return subprocess.run(
        [sys.executable, "-m", *arguments],
        cwd=tree,
        env={**os.environ, "PYTHONPATH": f"{tree}:{tree / 'simulator'}"},
        capture_output=True,
        text=True,
        timeout=HANG_S,
    )


def test_two_modes_of_two_authors_are_offered_and_fly(load, tmp_path):
    loaded = load(files_of(PAGE))
    modes = [cls for cls in loaded.values() if issubclass(cls, FlightMode)]
    assert {cls.NAME for cls in modes} >= {"EIGHT", "LEVEL"}
    wanted = {
        ("raspberry", "OUTPUT"): OutputCommand(1500, 1506, 0, 1600, 2),
        ("arduino", "SETPOINT"): SetpointCommand(0.0, 2.0),
    }
    for (controller, followed), published in wanted.items():
        rig = ManagerRig(
            tmp_path / controller,
            modes=[loaded["Eight"], loaded["Level"]],
            navigation="auto_mode: LEVEL\n",
            config=f"flight controller: {controller}\n",
        )
        rig.state(FBW_MODE)
        rig.sticks(ailerons=1900, rudder=1600)
        rig.frame()
        rig.state(FlightStateCommand(followed, True, True, False))
        rig.attitude()
        modes = rig.manager.telemetry_content["flight_control"]["modes"]
        assert {**modes, "LEVEL": None, "EIGHT": "navigation"} == modes
        assert rig.outcome(FlightModeCommand("EIGHT"))[0].value.detail == "reading_stale"
        assert [*rig.outputs, *rig.setpoints][-1:] == [published]


def test_the_authors_test_passes(tree):
    done = run(tree, "pytest", "-q", "-p", "no:cacheprovider", "tests/test_eight.py")
    assert "1 passed" in done.stdout, done.stdout + done.stderr


def test_it_flies_its_scenario(tree):
    # tests/simulator/scenarios/test_flight_mode_files.py flies another mode with both controllers.
    assert "flight controller: arduino" in (tree / "eight.yml").read_text()
    done = run(tree, "up_simulator", "fly", "eight.yml", "--no-picture", "--board", "host")
    assert done.returncode == 0, done.stdout + done.stderr


class Rig:
    """A controller with its providers on a bench; remembers the newest Output."""

    def __init__(self, controller, folder):
        folder.mkdir(exist_ok=True)
        (folder / "config.yml").write_text("flight controller: raspberry\n")
        self.bench = Bench(UpRXProvider, UpOrientationProvider, controller, config_folder=folder)
        self.controller = self.bench.module(controller)
        self.publish = self.bench.up.command_executor.execute_command
        self.output = None
        self.bench.up.command_executor.register_command(OutputCommand, self.keep)
        self.bench.start()
        self.sequence = 0

    def keep(self, command):
        self.output = command

    def fly(self, ailerons_us, roll_deg):
        """Publish inputs and an attitude; return the Output that follows, or None."""
        self.output = None
        self.publish(RXCommand(ailerons_us, 1500, 1300, 1500, 2000, 2000, 63), BOARD)
        self.sequence += 1
        self.publish(OrientationCommand(roll_deg, 0.0, 0.0, 0.0, 0.0, 0.0, self.sequence), BOARD)
        self.bench.advance(0.02)
        return self.output


def test_it_is_selected_from_the_ground(tmp_path):
    assert "`make run`" in (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")
    with flying(tmp_path, files_of(PAGE)) as flight:
        select, look = lines_of(PAGE, "eight")
        # Home and position are known some seconds after the start.
        flight.wait_for(lambda: "ack after" in flight.run(select).stdout)
        flight.wait_for(lambda: '"mode": "EIGHT"' in flight.run(look).stdout)


def test_the_wing_leveller_levels_and_is_silent_without_readings(load, tmp_path):
    source = shown("file: plane: flight_controller/wing_leveller.py")
    config = {"config/config.yml": "flight controller: raspberry\n"}
    loaded = load({"flight_controller/wing_leveller.py": source, **config})
    rig = Rig(loaded["WingLeveller"], tmp_path / "config")
    rig.publish(OrientationCommand(20.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1))
    assert rig.output is None
    assert rig.fly(1500, 20.0) == OutputCommand(1340, 1500, 0, 1500, 1)
    assert rig.fly(1500, -100.0).ailerons_us == 2000
    rig.bench.stop()
