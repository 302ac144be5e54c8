"""The compiled firmware in the glider's flight dynamics, with a Raspberry Pi that listens."""

from tests.support.firmware import build_firmware
from tests.support.tools import unavailable
from up_simulator.aircraft import FlightDynamics, Start, Weather, load_airframe
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.imu_errors import ImuErrors
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import cached_eeprom
from up_simulator.harness.world import World

ACRO, FBW, AUTO = 1000, 1500, 2000
BEAT_S = 0.02


class Flown:
    """A world that has been booted, the switch in position, and its output."""

    def __init__(
        self,
        *,
        aux1=FBW,
        seed=1,
        turbulence="none",
        start=None,
        errors=None,
        kind="firmware",
        arms=True,
        boots=True,
    ):
        build_firmware()
        self.airframe = load_airframe("glider")
        try:
            eeprom = cached_eeprom(kind, self.airframe.profile, self.airframe.gains)
            board = choose_board(kind, seed=seed, imu_errors=errors or ImuErrors(), eeprom=eeprom)
        except BoardUnavailableError as error:
            unavailable(str(error))
        weather = Weather(wind_m_s=0 if turbulence == "none" else 4, turbulence=turbulence)
        self.dynamics = FlightDynamics(self.airframe, start or Start(), weather, seed=seed)
        self.world = World(self.dynamics, board)
        self.board = board
        self.tap = LineMonitor()
        self.said = b""
        self.states = []
        board.set_stick("aux1", aux1)
        if boots:
            self.world.boot(arms=arms)
            self.listen()

    def listen(self):
        self.board.write(self.tap.start_bytes())

    def fly(self, duration_s):
        fresh = []
        for _ in range(round(duration_s / BEAT_S)):
            self.world.advance(BEAT_S)
            data = self.board.read()
            self.said += data
            self.tap.feed(data, self.world.time_s)
            fresh.append(self.world.state)
        self.states += fresh
        return fresh

    def status(self):
        self.listen()
        self.fly(0.24)
        assert self.world.time_s - self.tap.status_s < 0.24
        return self.tap.status
