"""The aircraft in the air with all participants, in one process."""

import hashlib

from tests.support.firmware import build_firmware
from up_simulator.aircraft.airframe import load_airframe
from up_simulator.aircraft.dynamics import FlightDynamics, Start
from up_simulator.firmware.imu_errors import ImuErrors
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import cached_eeprom
from up_simulator.firmware.rig_board import RigBoard
from up_simulator.harness.world import STEP_S, World
from up_simulator.in_process.config_folder import GROUND_PORT, write_config
from up_simulator.in_process.ground import InProcessGround
from up_simulator.in_process.phone import InProcessPhone
from up_simulator.in_process.raspilot import InProcessRaspilot
from up_simulator.in_process.reactor import SimulatedReactor
from up_simulator.link.model import LinkModel, LinkSettings
from up_simulator.scenario.line_board import FROM_BOARD, TO_BOARD, SerialWires

ACRO_US, FBW_US, AUTO_US = 1000.0, 1500.0, 2000.0
CELLULAR = LinkSettings(delay_ms=40, jitter_ms=10)


class TappedBoard:
    """Lets the serial line of a board be read along, both ways with their times, and corrupted."""

    def __init__(self, board, wires):
        self._board = board
        self.wires = wires
        self.tap = LineMonitor()
        self.digest = hashlib.sha256()

    def __getattr__(self, name):
        return getattr(self._board, name)

    @property
    def now_s(self):
        return self._board.now_us / 1e6

    def read(self):
        data = self._board.read()
        self.digest.update(b"<" + data)
        self.tap.feed(data, self.now_s)
        return self.wires.pass_on(data, FROM_BOARD, self.now_s)

    def write(self, data):
        data = self.wires.pass_on(data, TO_BOARD, self.now_s)
        self.digest.update(b">" + data)
        self._board.write(data)


class Flying:
    """A glider with the compiled firmware, booted and in the air, and its crew.

    The daemon, ground station and phone are there when the flight begins, not started.
    """

    def __init__(
        self,
        folder,
        files=None,
        *,
        seed=1,
        start=None,
        link=None,
        arms=False,
        orientation="tcp",
    ):
        airframe = load_airframe("glider")
        eeprom = cached_eeprom("firmware", airframe.profile, airframe.gains)
        rig = RigBoard(build_firmware(), seed=seed, imu_errors=ImuErrors(), eeprom=eeprom)
        self.board = TappedBoard(rig, SerialWires(seed))
        dynamics = FlightDynamics(airframe, start or Start(), seed=seed)
        self.world = World(dynamics, self.board)
        self.reactor = SimulatedReactor()
        gains = {name: airframe.gains[name] for name in airframe.gains}
        write_config(folder, {"pids.yml": gains, **(files or {})})
        self.raspilot = InProcessRaspilot(self.reactor, folder, seed=seed)
        if link is not None:
            self.up, self.down = LinkModel(link, seed), LinkModel(link, seed + 1)
            self.reactor.link(GROUND_PORT, self.up, self.down)
        self.ground = InProcessGround(self.reactor, seed=seed)
        self.phone = InProcessPhone(self.reactor, dynamics, orientation=orientation, seed=seed)
        self.board.set_stick("aux1", FBW_US)
        self.world.boot(arms=arms)

    @property
    def state(self):
        return self.world.state

    @property
    def status(self):
        return self.board.tap.status

    @property
    def now_s(self):
        return self.reactor.seconds()

    def start(self, *, phone=True):
        """Start all participants and fly until all communicate with each other."""
        self.raspilot.start()
        self.ground.start()
        if phone:
            self.phone.plug()
        self.until(lambda: self.ground.telemetry.get("flight_mode") is not None, 5.0)

    def step(self):
        self.world.step()
        self.raspilot.pump(self.board)
        self.reactor.advance(STEP_S)

    def fly(self, duration_s, each_step=lambda: None):
        for _ in range(round(duration_s / STEP_S)):
            self.step()
            each_step()

    def until(self, is_done, limit_s):
        """Fly until something holds; return how long it took."""
        for steps in range(round(limit_s / STEP_S)):
            if is_done():
                return steps * STEP_S
            self.step()
        raise AssertionError(f"not within {limit_s} s; " + "\n".join(self.raspilot.log[-10:]))

    def ask(self, name, limit_s=2.0, **data):
        """Send a Command from the ground and return its answer."""
        command_id = self.ground.send(name, **data)
        self.until(lambda: self.ground.answer(command_id) is not None, limit_s)
        return self.ground.answer(command_id)
