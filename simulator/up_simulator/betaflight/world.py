"""The aircraft on a Betaflight board: it is held until the board is armed."""

from __future__ import annotations

from up_rig.imu import motion_at
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.betaflight.board import BetaflightBoard
from up_simulator.firmware.board import BoardCrashedError, FirmwareBoard
from up_simulator.harness.world import STEP_US, THROTTLE, THROTTLE_LOW_US, World
from up_simulator.radio.sticks import HIGHEST_US, LOWEST_US, SWITCH_US, Sticks

TRY_US = 2e6
"""How long AUX2 is low, then high: the board arms when it rises, or refuses."""
IDLE_US = 20.0
"""The motor of an armed board idles, by more than this."""
BOOT_LIMIT_US = 60e6


class BetaflightWorld(World):
    """A world whose board lives in real time: its boot is the first part of the flight's time.

    At rest the board calibrates its gyro, and vetoes against arming may go away; then the flight
    begins in the air. With ``around``, a board around this one, ``boot`` waits for that.
    """

    def __init__(
        self, flight: FlightDynamics, board: BetaflightBoard, around: FirmwareBoard | None = None
    ) -> None:
        super().__init__(flight, around or board)
        self._betaflight = board
        self._is_awaited = around is not None

    def boot(self, *, arms: bool = False) -> None:
        """Hold the aircraft until the board is armed, if the pilot ``arms`` it on the ground.

        Raises ``BoardCrashedError`` when it does not arm within 60 s of an awaited boot.
        """
        board, now_us = self._betaflight, self.board.now_us
        board.on_ground = Sticks() if arms else None
        self.board.set_motion(motion_at(self.state.roll_deg, self.state.pitch_deg))
        if arms and self._is_awaited:
            board.set_stick("aux2", HIGHEST_US)
        while self._is_awaited and board.on_ground is not None:
            if self.board.now_us - now_us > BOOT_LIMIT_US:
                raise BoardCrashedError("Betaflight does not arm")
            self.step()

    def step(self) -> None:
        board = self._betaflight
        if board.on_ground is None:
            super().step()
            return
        self._steps += 1
        aux2 = HIGHEST_US if board.now_us // TRY_US % 2 else LOWEST_US
        board.on_ground = Sticks(aux1=SWITCH_US["FBW"], aux2=aux2)
        self.board.run_us(STEP_US)
        if board.pulses_us()[THROTTLE] > THROTTLE_LOW_US + IDLE_US:
            board.on_ground = None

    def close(self) -> None:
        self._betaflight.close()


class NoLine:
    """The serial line of a board that has none."""

    def read(self, timeout_s: float, most: int) -> bytes:
        return b""

    def write(self, data: bytes) -> None:
        """Drop the data."""
