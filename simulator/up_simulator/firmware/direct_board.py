"""No flight computer at all: the receiver's wires go straight to the servos."""

from __future__ import annotations

import math
import random

from up_rig.imu import Motion
from up_rig.pins import CHANNELS, SERVOS
from up_rig.receiver import NEUTRAL_US as RECEIVER_NEUTRAL_US
from up_simulator.firmware.board import NEUTRAL_US, Channel, Pulses, ResetCause
from up_simulator.firmware.imu_errors import BoardImu, ImuErrors

FRAME_US = 20_000.0
GAP_US = 10.0


class DirectBoard:
    """A ``FirmwareBoard`` without firmware: Black Box mode, and an unassisted flight.

    Frames of six pulses, one after the other, are sent every 20 ms; a servo has the newest whole
    one. The serial line is silent and nothing resets.
    """

    title = "no flight computer: the receiver moves the servos"

    def __init__(self, *, seed: int = 1, imu_errors: ImuErrors | None = None) -> None:
        self.imu = BoardImu(imu_errors or ImuErrors(), seed)
        self._now_us = 0.0
        self._frame_us = random.Random(f"receiver start {seed}").uniform(0, FRAME_US)
        self._sticks_us: dict[str, float] = dict(RECEIVER_NEUTRAL_US)
        self._silent: set[str] = set()
        self._coming: list[tuple[float, str, float]] = []
        self._pulses_us = dict(zip(SERVOS, NEUTRAL_US, strict=True))
        self._ended_us = dict.fromkeys(SERVOS, -math.inf)

    @property
    def now_us(self) -> float:
        return self._now_us

    def run_us(self, duration_us: float) -> None:
        self._now_us += duration_us
        while self._frame_us <= self._now_us:
            self._send_frame(self._frame_us)
            self._frame_us += FRAME_US
        while self._coming and self._coming[0][0] <= self._now_us:
            end_us, channel, width_us = self._coming.pop(0)
            self._pulses_us[channel] = width_us
            self._ended_us[channel] = end_us

    def set_stick(self, channel: Channel, width_us: float) -> None:
        self._sticks_us[channel] = width_us

    def set_receiver(self, is_on: bool) -> None:
        self._silent = set() if is_on else set(CHANNELS)

    def set_channel(self, channel: Channel, is_on: bool) -> None:
        if is_on:
            self._silent.discard(channel)
        else:
            self._silent.add(channel)

    def set_motion(self, motion: Motion) -> None:
        """Ignore the motion: this board has no IMU."""

    def set_a7(self, volts: float) -> None:
        """Ignore the voltage: this board measures none."""

    def pulses_us(self) -> Pulses:
        ailerons, elevator, throttle, rudder = (self._pulses_us[each] for each in SERVOS)
        return ailerons, elevator, throttle, rudder

    def pulse_ages_us(self) -> tuple[float, float, float, float]:
        ailerons, elevator, throttle, rudder = (
            self._now_us - self._ended_us[each] for each in SERVOS
        )
        return ailerons, elevator, throttle, rudder

    def read(self) -> bytes:
        return b""

    def write(self, data: bytes) -> None:
        """Drop the data: this board has no serial line."""

    def reset(self, cause: ResetCause) -> None:
        """Do nothing: this board has no state to reset."""

    @property
    def eeprom(self) -> bytes:
        return b""

    def _send_frame(self, start_us: float) -> None:
        at_us = start_us
        for channel in CHANNELS:
            at_us += self._sticks_us[channel]
            if channel in self._pulses_us and channel not in self._silent:
                self._coming.append((at_us, channel, self._sticks_us[channel]))
            at_us += GAP_US
