"""The cog and a board on a real pty: the compiled firmware, and an old one."""

import os
import signal
import subprocess
import sys

import pytest
from twisted.internet.task import LoopingCall

from tests.cogs.arduino_cog.bench_board import BenchBoard
from tests.cogs.arduino_cog.board import MODULES
from tests.support.firmware import build_firmware
from tests.support.reactor import reactor, run_in_reactor, until
from tests.support.system import build_up, started
from up.base_started_module import BaseStartedModule
from up.commands.arming_commands import ArmCommand
from up.commands.board_schema import Veto
from up.commands.origin import INTERNAL
from up.commands.output_command import SetpointCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand
from up.commands.refusal import CommandRefusedError
from up.commands.servo_command import ServoCommand
from up.flight_controller.pids_file import PIDS

from arduino_cog.modules.arduino_provider import ArduinoProvider  # isort: skip
from arduino_cog.modules.pid_tunings_provider import PIDTuningsProvider  # isort: skip

LOOP = {axis: {"p": 3.25, "i": 0.5, "d": 0.1} for axis in ("ailerons", "elevator", "rudder")}


class Aircraft:
    """The board, in its own process; ``command`` follows ``python -m``."""

    def __init__(self, link, *command):
        self.link = link
        self.command = command
        self.process = None

    def fly(self):
        self.process = subprocess.Popen(
            [sys.executable, "-m", *self.command, "--pty-link", str(self.link)],
            stdout=subprocess.DEVNULL,
        )

    async def is_there(self):
        await until(self.link.exists, what="the board's pty")

    def end(self, number=signal.SIGTERM):
        if self.process is not None:
            self.process.send_signal(number)
            self.process.wait(30)
            self.process = None


@pytest.fixture
def fly_aircraft(tmp_path):
    made = []

    def make(*command):
        made.append(Aircraft(tmp_path / "board", *command))
        made[-1].fly()
        return made[-1]

    yield make
    for each in made:
        each.end()


def system(tmp_path, framing="checked", modules=MODULES):
    config = {
        "arduino.yml": f"port: {tmp_path / 'board'}\nframing: {framing}\n",
        "pids.yml": PIDS.template().replace("p: 2.0", "p: 2.25"),
    }
    return build_up(modules, reactor, tmp_path / "config", config=config)


async def ask(up, command):
    """Return nothing, or the reason for a refusal."""
    try:
        await up.command_executor.execute_and_wait(command, INTERNAL)
    except CommandRefusedError as error:
        return error.reason
    return None


class FlightMode(BaseStartedModule):
    """Requests a bank, 50 times a second."""

    ROLL_DEG = 0.0

    def on_start(self):
        self.loop = LoopingCall(self.step)
        self.loop.start(0.02)

    def on_stop(self):
        self.loop.stop()

    def step(self):
        self.up.command_executor.execute_command(SetpointCommand(self.ROLL_DEG, 0.0))


class Thermal(FlightMode):
    ROLL_DEG = 30.0


class Glide(FlightMode):
    ROLL_DEG = -30.0


def test_two_modules_that_publish_setpoints_do_not_alternate_on_the_servos(tmp_path):
    board = BenchBoard(
        os.environ.get("RASPILOT_ELF") or build_firmware(),
        tmp_path / "board",
        {"throttle": 1000, "aux2": 1000},
    )

    async def fly():
        up = system(tmp_path, modules=[*MODULES, Thermal, Glide])
        life = await started(up)
        arduino = up.get_module(ArduinoProvider)
        await until(lambda: arduino.status is not None and arduino.status.vetoes == Veto.AUX2_LOW)
        # The firmware arms on an edge that follows 300 ms of low.
        low_s = arduino.status.uptime_s + 2
        await until(lambda: arduino.status.uptime_s >= low_s)
        board.move(aux2=2000)
        await until(lambda: arduino.status.mode == ord("s"), what="SETPOINT")
        owner = up.command_executor.control.owner
        ailerons = []
        up.command_executor.register_command(
            ServoCommand, lambda servo: ailerons.append(servo.ailerons_us)
        )
        await until(lambda: len(ailerons) >= 40)
        is_right = owner == "Thermal"
        assert all((each > 1600) is is_right and each != 1500 for each in ailerons), ailerons
        assert set(up.command_executor.control.refused) == {"Thermal", "Glide"} - {owner}
        await life.stop()

    board.fly()
    try:
        run_in_reactor(fly)
    finally:
        board.end()


async def test_an_old_firmware_with_its_boot_text(fly_aircraft, tmp_path):
    plane = fly_aircraft("tests.support.old_firmware", "--boot-text", "DMP init failed")
    await plane.is_there()
    up = system(tmp_path, "thesis")
    life = await started(up)
    arduino = up.get_module(ArduinoProvider)
    gains = up.get_module(PIDTuningsProvider)
    await until(lambda: arduino.servo is not None)
    await until(lambda: gains.current is not None and gains.current.rate.ailerons.p == 2.25)
    two_axes = {axis: LOOP[axis] for axis in ("ailerons", "elevator")}
    command = PIDTuningsCommand(pids={"ratePIDs": two_axes, "stabPIDs": two_axes})
    assert await ask(up, command) is None
    assert gains.current.stabilize.elevator.p == 3.25
    assert "framing: thesis" in await ask(up, ArmCommand())
    content = up.telemetry_controller.collect()
    assert content["orientation"]["roll"] is not None
    assert "rx" not in content
    await life.stop()
