"""The same firmware compiled for this computer, for where the AVR compiler is missing."""

from __future__ import annotations

import ctypes
import random
from pathlib import Path

from up_rig.imu import GRAVITY_M_S2, Motion
from up_rig.pins import CHANNELS
from up_simulator.firmware.board import NEUTRAL_US, Channel, Pulses, ResetCause
from up_simulator.firmware.host_library import (
    EEPROM_SIZE,
    SAMPLE_NUMBERS,
    HostLibrary,
    View,
)
from up_simulator.firmware.imu_errors import BoardImu, ImuErrors, ImuFault

_CAUSES: dict[ResetCause, int] = {"power": 1, "button": 2, "brown-out": 4, "watchdog": 8}
_CHANNELS = {channel: at for at, channel in enumerate(CHANNELS)}
_READ_SIZE = 4096
_GYRO_CONFIG, _ACCEL_CONFIG = 27, 28
_COUNTS_DEG_S, _COUNTS_G = 131.0, 16384.0
# 25 degrees (PS-MPU-6000A-00, 6.2: 340 counts a degree, 0 at 36.53 degrees).
_TEMPERATURE = round((25.0 - 36.53) * 340)


class HostImu(BoardImu):
    """The MPU6050's measurements in a host build."""

    def __init__(self, library: HostLibrary, errors: ImuErrors, seed: int) -> None:
        super().__init__(errors, seed)
        self._library = library
        self._view: View = library.view
        self._sample = library.view.sample
        self._garbage = random.Random(f"imu {seed}")
        self._numbers = [0] * SAMPLE_NUMBERS

    def set_fault(self, fault: ImuFault) -> None:
        super().set_fault(fault)
        self._library.set_imu_fault({"unplugged": 1, "stuck": 2}.get(fault, 0))

    def give_sample(self) -> None:
        if self.fault == "garbage":
            self._numbers = [self._garbage.randint(-32768, 32767) for _ in range(SAMPLE_NUMBERS)]
        elif self.fault != "frozen":
            self._numbers = self._measure()
        self._sample[:] = self._numbers

    def _measure(self) -> list[int]:
        view = self._view
        felt = self.measure(view.sample_us / 1e6)
        registers = view.imu_registers
        a_deg_s = _COUNTS_DEG_S / (1 << (registers[_GYRO_CONFIG] >> 3 & 3))
        a_m_s2 = _COUNTS_G / (1 << (registers[_ACCEL_CONFIG] >> 3 & 3)) / GRAVITY_M_S2
        # The chip lies x forward, y left, z up.
        counts = [
            round(felt.force_x_m_s2 * a_m_s2),
            round(-felt.force_y_m_s2 * a_m_s2),
            round(-felt.force_z_m_s2 * a_m_s2),
            _TEMPERATURE,
            round(felt.roll_rate_deg_s * a_deg_s),
            round(-felt.pitch_rate_deg_s * a_deg_s),
            round(-felt.yaw_rate_deg_s * a_deg_s),
        ]
        if min(counts) < -32768 or max(counts) > 32767:
            return [max(-32768, min(32767, count)) for count in counts]
        return counts


class HostBoard:
    """A ``FirmwareBoard`` that runs the firmware's sources, compiled for this computer.

    The chip's hardware is modelled by function, not by register: pulses are exact, and the time
    that its instructions take is a guess. Raises ``RigUnavailableError``.
    """

    title = "the firmware compiled for this computer"

    def __init__(
        self, library: str | Path, *, seed: int = 1, imu_errors: ImuErrors, eeprom: bytes = b""
    ) -> None:
        if len(eeprom) > EEPROM_SIZE:
            raise ValueError(f"the EEPROM has {EEPROM_SIZE} bytes")
        self._library = HostLibrary(Path(library))
        self.imu = HostImu(self._library, imu_errors, seed)
        self._until_us = 0.0
        self._width_us = self._library.view.width_us
        self._ended_us = self._library.view.ended_us
        self._into = ctypes.create_string_buffer(_READ_SIZE)
        # As in the rig: a receiver has no reason to begin with the board.
        start_us = 100_000 + random.Random(f"receiver start {seed}").uniform(0, 20_000)
        self._library.begin(eeprom, len(eeprom), seed & 0xFFFFFFFF, start_us)

    @property
    def now_us(self) -> float:
        return float(self._library.view.now_us)

    def run_us(self, duration_us: float) -> None:
        self._until_us += duration_us
        while self._library.run(self._until_us):
            self.imu.give_sample()

    def set_stick(self, channel: Channel, width_us: float) -> None:
        self._library.set_stick(_CHANNELS[channel], width_us)

    def set_receiver(self, is_on: bool) -> None:
        self._library.set_receiver(is_on)

    def set_channel(self, channel: Channel, is_on: bool) -> None:
        self._library.set_channel(_CHANNELS[channel], is_on)

    def set_motion(self, motion: Motion) -> None:
        self.imu.motion = motion

    def set_a7(self, volts: float) -> None:
        self._library.set_a7(volts)

    def pulses_us(self) -> Pulses:
        # 0: no pulse yet.
        ailerons, elevator, throttle, rudder = self._width_us
        neutral = NEUTRAL_US
        return (
            ailerons or neutral[0],
            elevator or neutral[1],
            throttle or neutral[2],
            rudder or neutral[3],
        )

    def pulse_ages_us(self) -> tuple[float, float, float, float]:
        now_us = self.now_us
        ailerons, elevator, throttle, rudder = self._ended_us
        return now_us - ailerons, now_us - elevator, now_us - throttle, now_us - rudder

    def read(self) -> bytes:
        parts = []
        while size := self._library.read(self._into, _READ_SIZE):
            parts.append(self._into.raw[:size])
        return b"".join(parts)

    def write(self, data: bytes) -> None:
        self._library.write(data, len(data))

    def reset(self, cause: ResetCause) -> None:
        """Reset it now; neither power-on nor brown-out is long enough to lose the RAM."""
        self._library.reset(_CAUSES[cause])

    @property
    def eeprom(self) -> bytes:
        return bytes(self._library.view.eeprom)
