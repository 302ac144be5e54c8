"""The flight modes of docs/how-to/flight-mode.md fly."""

from __future__ import annotations

import re
import sys

import pytest

from tests.docs.flying import files_of, flying, lines_of
from tests.support.application import plan_of, write_application
from tests.support.virtual_environment import REPOSITORY
from up.commands.flight_state_command import FlightStateCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.output_command import OutputCommand
from up.commands.refusal import CommandRefusedError
from up.commands.roles import Role
from up.commands.rx_command import RXCommand
from up.providers.base_rx_provider import UpRXProvider
from up.providers.up_orientation_provider import UpOrientationProvider
from up.testing import Bench

PAGE = "how-to/flight-mode.md"
BOARD = Origin("arduino", Role.BOARD, priority=10)
LEVEL = "flight_controller/level_flight_controller.py"


def leveller_source():
    text = (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")
    return re.search(r"<!-- file: plane: \S+ -->\n```python\n(.*?)```", text, re.DOTALL)[1]


@pytest.fixture
def controllers(tmp_path):
    """The controllers of an application that holds a file of the page, by name."""
    packages = []

    def load(name, text):
        files = {
            f"flight_controller/{name}.py": text,
            "config/config.yml": "flight controller: raspberry\n",
        }
        application = write_application(tmp_path / name, files)
        packages.append(application.package)
        plan = plan_of(application)
        assert not plan.problems
        return {module.class_name: type(module) for module in plan.modules}

    yield load
    for name in [name for name in sys.modules if name.split(".")[0] in packages]:
        del sys.modules[name]


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


def test_level_ignores_the_sticks_and_only_when_it_is_on(controllers, tmp_path):
    # As on the page it extends Raspilot's controller, here as a separate application.
    loaded = controllers("level_flight_controller", files_of(PAGE)[LEVEL])
    controller = loaded["LevelFlightController"]
    level = sys.modules[controller.__module__].LevelCommand
    rig = Rig(controller, tmp_path / "config")
    with pytest.raises(CommandRefusedError, match="rx, orientation"):
        rig.controller.on_level(level(on=True))
    rig.publish(FlightStateCommand("OUTPUT", True, True, False))
    assert rig.fly(1900, 0.0).ailerons_us > 1550
    rig.publish(level(on=True))
    resets = []
    rig.controller._reset = lambda: resets.append(1)
    assert rig.fly(1900, 0.0).ailerons_us == 1500
    assert rig.fly(1900, 10.0).ailerons_us < 1500
    assert rig.controller.flight_mode == "LEVEL"
    assert not resets, "a mode of one's own must not cost the controllers their memory"
    rig.publish(level(on=False))
    assert rig.fly(1900, 0.0).ailerons_us > 1550
    rig.bench.stop()


def test_level_is_switched_from_the_ground_in_flight(tmp_path):
    make_run = "make run CONTROLLER=raspberry"
    assert f"`{make_run}`" in (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")
    with flying(tmp_path, files_of(PAGE), make_run) as flight:
        on, look = lines_of(PAGE, "level")
        done = flight.run(on)
        assert "ack after" in done.stdout, done.stdout + done.stderr
        flight.wait_for(lambda: '"mode": "LEVEL"' in flight.run(look).stdout)


def test_the_wing_leveller_levels_and_is_silent_without_readings(controllers, tmp_path):
    loaded = controllers("wing_leveller", leveller_source())
    rig = Rig(loaded["WingLeveller"], tmp_path / "config")
    rig.publish(OrientationCommand(20.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1))
    assert rig.output is None
    assert rig.fly(1500, 20.0) == OutputCommand(1340, 1500, 0, 1500, 1)
    assert rig.fly(1500, -100.0).ailerons_us == 2000
    rig.bench.stop()
