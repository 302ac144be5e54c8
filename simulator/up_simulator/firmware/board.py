"""The interface of a simulated flight to its board."""

from __future__ import annotations

from typing import Literal, Protocol

from up_rig.imu import Motion
from up_simulator.firmware.imu_errors import BoardImu

Channel = Literal["ailerons", "elevator", "throttle", "rudder", "aux1", "aux2"]
ResetCause = Literal["watchdog", "power", "button", "brown-out"]
BoardKind = Literal["auto", "firmware", "host", "direct"]
Pulses = tuple[float, float, float, float]
"""Servo pulses, us: ailerons, elevator, throttle, rudder."""

NEUTRAL_US: Pulses = (1500.0, 1500.0, 1000.0, 1500.0)


class BoardCrashedError(Exception):
    """The board's program used a feature that its chip lacks: the message is one sentence."""


class FirmwareBoard(Protocol):
    """A board with its receiver, servos, IMU and serial line, in its own time.

    Times are microseconds since its first power-on; they never fall, whatever resets it.
    """

    @property
    def title(self) -> str:
        """Return its description, in a few words."""

    @property
    def imu(self) -> BoardImu:
        """Return its sensor."""

    @property
    def now_us(self) -> float:
        """Return the board's time."""

    def run_us(self, duration_us: float) -> None:
        """Run on; raises ``BoardCrashedError``."""

    def set_stick(self, channel: Channel, width_us: float) -> None:
        """Set the receiver's pulse of a channel, from its next frame on."""

    def set_receiver(self, is_on: bool) -> None:
        """Switch all channels of the receiver on or off."""

    def set_channel(self, channel: Channel, is_on: bool) -> None:
        """Switch the pulses of one channel of the receiver on or off."""

    def set_motion(self, motion: Motion) -> None:
        """Set the IMU's motion from now on."""

    def set_a7(self, volts: float) -> None:
        """Set the voltage at pin A7, where the flight battery's divider is, from now on."""

    def pulses_us(self) -> Pulses:
        """Return the newest whole servo pulses; ``NEUTRAL_US`` before the first."""

    def pulse_ages_us(self) -> tuple[float, float, float, float]:
        """Return how long ago the newest pulse of each servo ended; infinite before the first."""

    def read(self) -> bytes:
        """Return the bytes from the serial line since the last call."""

    def write(self, data: bytes) -> None:
        """Put bytes on the serial line."""

    def reset(self, cause: ResetCause) -> None:
        """Reset it now."""

    @property
    def eeprom(self) -> bytes:
        """Return the content of the EEPROM; empty for a board without one."""
