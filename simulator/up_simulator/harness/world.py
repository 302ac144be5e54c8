"""An aircraft, its air and its board, in one time."""

from __future__ import annotations

import math

from up_rig.imu import Motion, motion_at
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.aircraft.flight import FlightState
from up_simulator.firmware.board import FirmwareBoard, Pulses

STEP_S = 0.002
STEP_US = 2000.0
BYTES_A_STEP = 23
"""Bytes of a line of 115200 baud in a step: the rest waits, as on a real line."""
STILL_S = 2.0
TILT_S = 1.0
SETTLE_S = 0.5
THROTTLE, THROTTLE_LOW_US, THROTTLE_RANGE_US = 2, 1000.0, 1000.0


class World:
    """The board and the flight in lockstep: 2 ms of the one, 2 ms of the other.

    Time begins in the air: ``boot`` runs the board before, on the ground, and need not be called
    for a flight that begins with a freshly powered board.
    """

    def __init__(self, dynamics: FlightDynamics, board: FirmwareBoard) -> None:
        self.dynamics = dynamics
        self.board = board
        self._steps = 0
        self._owed_s = 0.0

    @property
    def time_s(self) -> float:
        return self._steps * STEP_S

    @property
    def state(self) -> FlightState:
        return self.dynamics.state

    def boot(self, *, arms: bool = False) -> None:
        """Switch the board on at rest and level, then tilt it to how the flight begins.

        The aircraft lies still until the gyro is calibrated; ``arms`` then moves AUX2 from low to
        high, for which the throttle's stick must be low. Raises ``BoardCrashedError``.
        """
        board = self.board
        board.set_motion(motion_at(0.0, 0.0))
        board.set_a7(self.dynamics.a7_v)
        board.run_us(STILL_S * 1e6)
        if arms:
            board.set_stick("aux2", 1000.0)
            board.run_us(SETTLE_S * 1e6)
            board.set_stick("aux2", 2000.0)
            board.run_us(SETTLE_S * 1e6)
        self._tilt(self.state.roll_deg, self.state.pitch_deg)
        self._feel(board.pulses_us())

    def step(self) -> None:
        """Run the board for 2 ms, then the flight. Raises ``BoardCrashedError``."""
        self.board.run_us(STEP_US)
        pulses_us = self.board.pulses_us()
        self.dynamics.set_servos(pulses_us)
        self.dynamics.advance(STEP_S)
        self._steps += 1
        self._feel(pulses_us)

    def close(self) -> None:
        """Release what the board takes of this computer."""

    def advance(self, duration_s: float) -> None:
        """Run all whole steps of the time requested so far. Raises ``BoardCrashedError``."""
        self._owed_s += duration_s
        while self._owed_s >= STEP_S - 1e-9:
            self._owed_s -= STEP_S
            self.step()

    def _feel(self, pulses_us: Pulses) -> None:
        part = (pulses_us[THROTTLE] - THROTTLE_LOW_US) / THROTTLE_RANGE_US
        self.board.imu.throttle = min(1.0, max(0.0, part))
        self.board.set_a7(self.dynamics.a7_v)
        is_flying = self.dynamics.crash is None
        self.board.set_motion(self.dynamics.motion if is_flying else self._lying())

    def _lying(self) -> Motion:
        state = self.state
        if not math.isfinite(state.roll_deg + state.pitch_deg):
            return motion_at(0.0, 0.0)
        return motion_at(state.roll_deg, state.pitch_deg)

    def _tilt(self, roll_deg: float, pitch_deg: float) -> None:
        """Pitch, then roll, within a second each; the rates are those of the body's axes."""
        steps = round(TILT_S / STEP_S)
        for turns_pitch in (True, False):
            for at in range(steps):
                part = _eased(at + 0.5, steps)
                rate = (_eased(at + 1, steps) - _eased(at, steps)) / STEP_S
                if turns_pitch:
                    motion = motion_at(0.0, pitch_deg * part, (0.0, pitch_deg * rate, 0.0))
                else:
                    motion = motion_at(roll_deg * part, pitch_deg, (roll_deg * rate, 0.0, 0.0))
                self.board.set_motion(motion)
                self.board.run_us(STEP_US)


def _eased(at: float, steps: int) -> float:
    """Return the part of the way that is done: it begins and ends without a jerk."""
    return 0.5 - 0.5 * math.cos(math.pi * at / steps)
