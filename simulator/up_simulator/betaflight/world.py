"""The aircraft on a Betaflight board: it is held until the board is armed."""

from __future__ import annotations

from up_rig.imu import motion_at
from up_simulator.aircraft.flight import FlightSource
from up_simulator.betaflight.board import BetaflightBoard
from up_simulator.harness.world import STEP_US, THROTTLE, THROTTLE_LOW_US, World
from up_simulator.radio.sticks import HIGHEST_US, LOWEST_US, SWITCH_US, Sticks

TRY_US = 2e6
"""How long AUX2 is low, then high: the board arms when it rises, or refuses."""
IDLE_US = 20.0
"""The motor of an armed board idles, by more than this."""


class BetaflightWorld(World):
    """A world whose board lives in real time: its boot is the first part of the flight's time.

    At rest the board calibrates its gyro, and vetoes against arming may go away; then the flight
    begins in the air.
    """

    def __init__(self, flight: FlightSource, board: BetaflightBoard) -> None:
        super().__init__(flight, board)
        self._betaflight = board

    def boot(self, *, arms: bool = False) -> None:
        """Hold the aircraft until the board is armed, if the pilot ``arms`` it on the ground."""
        self._betaflight.on_ground = Sticks() if arms else None
        self.board.set_motion(motion_at(self.state.roll_deg, self.state.pitch_deg))

    def step(self) -> None:
        board = self._betaflight
        if board.on_ground is None:
            super().step()
            return
        self._steps += 1
        aux2 = HIGHEST_US if board.now_us // TRY_US % 2 else LOWEST_US
        board.on_ground = Sticks(aux1=SWITCH_US["FBW"], aux2=aux2)
        board.run_us(STEP_US)
        if board.pulses_us()[THROTTLE] > THROTTLE_LOW_US + IDLE_US:
            board.on_ground = None


class NoLine:
    """The serial line of a board that has none."""

    def read(self, timeout_s: float, most: int) -> bytes:
        return b""

    def write(self, data: bytes) -> None:
        """Drop the data."""
