"""The compiled firmware on a simulated ATmega328P."""

from __future__ import annotations

import math
import random
from pathlib import Path
from typing import get_args

from up_rig import SERVOS, CrashError, Motion, Rig
from up_rig.imu import Fault
from up_simulator.firmware.board import NEUTRAL_US, BoardCrashedError, Channel, Pulses, ResetCause
from up_simulator.firmware.imu_errors import BoardImu, ImuErrors, ImuFault

CYCLES_PER_US = 16
_A7 = 7


class RigImu(BoardImu):
    """The MPU6050 of the rig, with the errors of a ``BoardImu`` in place of the rig's own."""

    def __init__(self, rig: Rig, errors: ImuErrors, seed: int) -> None:
        super().__init__(errors, seed)
        self._imu = rig.imu
        self._imu.noise_deg_s = self._imu.noise_m_s2 = 0.0
        self._imu.motion = self.measure

    def set_fault(self, fault: ImuFault) -> None:
        imu = self._imu
        imu.mend()
        imu.is_frozen = fault == "frozen"
        imu.is_garbage = fault == "garbage"
        if fault == "unplugged":
            imu.unplug()
        else:
            imu.plug()
        if fault == "stuck":
            imu.fail(Fault.SDA_LOW)
        super().set_fault(fault)


class RigBoard:
    """A ``FirmwareBoard`` that runs the machine code in a ``Rig``.

    Servo pulses are those measured at the pins, the IMU's bytes pass the two-wire bus. The
    receiver's frames begin 100 ms after power-on. Raises ``FirmwareError`` and
    ``RigUnavailableError``.
    """

    title = "the firmware on a simulated ATmega328P"

    def __init__(
        self, elf: str | Path, *, seed: int = 1, imu_errors: ImuErrors, eeprom: bytes = b""
    ) -> None:
        self._rig = Rig(elf, seed=seed, eeprom=eeprom, is_measuring=False)
        self.imu = RigImu(self._rig, imu_errors, seed)
        self._until_us = 0.0
        self._rig.servo.record(False)
        # A receiver has no reason to begin with the board.
        start_us = 100_000 + random.Random(f"receiver start {seed}").uniform(0, 20_000)
        self._rig.receiver.start(at_us=start_us)

    @property
    def now_us(self) -> float:
        return self._rig.now_us

    def run_us(self, duration_us: float) -> None:
        # Not from now: a run ends with an instruction, thus a little late.
        self._until_us += duration_us
        try:
            self._rig.run_until_us(self._until_us)
        except CrashError as crash:
            raise BoardCrashedError(f"{self.title}: {crash}") from crash
        self._rig.receiver.sent.clear()

    def set_stick(self, channel: Channel, width_us: float) -> None:
        self._rig.receiver.set(channel, width_us)

    def set_receiver(self, is_on: bool) -> None:
        for channel in get_args(Channel):
            self.set_channel(channel, is_on)

    def set_channel(self, channel: Channel, is_on: bool) -> None:
        # Frames continue without output: a restarted frame could run into the one before.
        if is_on:
            self._rig.receiver.resume(channel)
        else:
            self._rig.receiver.stop(channel)

    def set_motion(self, motion: Motion) -> None:
        self.imu.motion = motion

    def set_a7(self, volts: float) -> None:
        self._rig.set_analog(_A7, volts)

    def pulses_us(self) -> Pulses:
        newest = self._rig.servo.last_pulse
        ailerons, elevator, throttle, rudder = (
            neutral_us if (pulse := newest(channel)) is None else pulse.width_us
            for channel, neutral_us in zip(SERVOS, NEUTRAL_US, strict=True)
        )
        return ailerons, elevator, throttle, rudder

    def pulse_ages_us(self) -> tuple[float, float, float, float]:
        ailerons, elevator, throttle, rudder = (self._age_us(channel) for channel in SERVOS)
        return ailerons, elevator, throttle, rudder

    def read(self) -> bytes:
        return self._rig.serial.read()

    def write(self, data: bytes) -> None:
        self._rig.serial.write(data)

    def reset(self, cause: ResetCause) -> None:
        """Reset it now; a brown-out is too short to lose the RAM."""
        match cause:
            case "watchdog":
                self._rig.force_watchdog_reset()
            case "power":
                self._rig.power_on()
            case "button":
                self._rig.press_reset()
            case "brown-out":
                self._rig.brown_out()

    @property
    def eeprom(self) -> bytes:
        return self._rig.eeprom.read()

    def _age_us(self, channel: str) -> float:
        pulse = self._rig.servo.last_pulse(channel)
        if pulse is None:
            return math.inf
        return self.now_us - (pulse.rise_cycle + pulse.width_cycles) / CYCLES_PER_US
