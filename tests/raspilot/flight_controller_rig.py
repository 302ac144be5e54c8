"""The flight mode manager with a board, a ground and a pilot, for its tests."""

from dataclasses import replace

from twisted.internet.task import Clock

from raspilot.flight_controller.attitude_controller import AttitudeController
from raspilot.flight_controller.flight_mode_manager import FlightModeManager
from raspilot.flight_modes.acro import Acro
from raspilot.flight_modes.fbw import FlyByWire
from tests.support.system import build_up
from up.commands.flight_state_command import (
    FlightModeCommand,
    FlightStateCommand,
)
from up.commands.gains import Gains, GainSet, LoopGains
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.output_command import OutputCommand, SetpointCommand
from up.commands.roles import Role
from up.commands.rx_command import ALL_VALID, RXCommand
from up.flight_controller.pids_file import PidsFile
from up.mode import Mode
from up.providers.base_mission_control_provider import BaseMissionControlProvider

BOARD = Origin("arduino", Role.BOARD, 10)
PHONE = Origin("android", Role.SENSOR, 0)
GROUND = Origin("ground", Role.PILOT, 0)
CONFIG = {"config.yml": "flight controller: raspberry\n"}
OUTPUT_MODE = FlightStateCommand("OUTPUT", True, True, False)
FBW_MODE = FlightStateCommand("FBW", True, True, False)
MANUAL = FlightStateCommand("FBW", True, False, False)
LOOP = LoopGains(Gains(3.0, 0.5, 0.1), Gains(1.5), Gains(0.25))
OTHER_GAINS = GainSet(LOOP, replace(LOOP, rudder=Gains(0.0)))


class Ground(BaseMissionControlProvider):
    """A ground that records received messages."""

    def __init__(self):
        super().__init__()
        self.sent, self.is_there = [], True

    @property
    def wants_telemetry(self):
        return self.is_there

    def send_command(self, command, command_id=None):
        self.sent.append(command)
        return self.is_there

    def _transmit_data(self, message):
        return True

    def _transmit_newest(self, message):
        pass


class Rig:
    """A flight controller, a board and a pilot."""

    def __init__(
        self,
        folder,
        *,
        gains=OTHER_GAINS,
        clock=None,
        mode=Mode.AUTO,
        modes=(FlyByWire, Acro),
        modules=(),
        **config,
    ):
        folder.mkdir(exist_ok=True)
        if gains is not None:
            PidsFile(folder).save(gains)
        self.clock = clock or Clock()
        self.up = build_up(
            (FlightModeManager, AttitudeController, *modes, *modules, Ground),
            self.clock, folder, mode=mode,
            config={**CONFIG, **{name + ".yml": text for name, text in config.items()}},
        )  # fmt: skip
        self.bus = self.up.command_executor
        self.manager = self.up.get_module(FlightModeManager)
        self.controller = self.up.get_module(AttitudeController)
        self.ground = self.up.get_module(Ground)
        self.outputs, self.setpoints, self.modes = [], [], []
        self.bus.register_command(SetpointCommand, self.setpoints.append)
        self.bus.register_command(OutputCommand, self.outputs.append)
        self.bus.register_command(FlightModeCommand, self.modes.append)
        self.sequence = 0

    def state(self, state=OUTPUT_MODE):
        self.bus.execute_command(state, BOARD)

    def sticks(self, ailerons=1500, elevator=1500, throttle=1400, rudder=1500, valid=ALL_VALID):
        self.bus.execute_command(
            RXCommand(ailerons, elevator, throttle, rudder, 2000, 2000, valid), BOARD
        )

    def attitude(self, roll=0.0, pitch=0.0, yaw=0.0, rates=(0.0, 0.0, 0.0), origin=BOARD, **more):
        self.sequence = more.get("sequence", self.sequence + 1)
        self.bus.execute_command(
            OrientationCommand(roll, pitch, yaw, *rates, self.sequence), origin
        )

    def frame(self, *attitude, **more):
        """Let a period pass and a frame come; return the Output that it made, or None."""
        self.clock.advance(0.02)
        count = len(self.outputs)
        self.attitude(*attitude, **more)
        return self.outputs[-1] if len(self.outputs) > count else None

    def outcome(self, command, origin=GROUND):
        got = []
        self.bus.execute_and_wait(command, origin).addBoth(got.append)
        return got
