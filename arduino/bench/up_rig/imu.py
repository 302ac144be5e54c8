"""The MPU6050 on its bus: its measurements and its faults."""

from __future__ import annotations

import ctypes
import enum
import math
import random
import struct
from collections.abc import Callable
from dataclasses import dataclass

from up_rig.library import Handle, SampleFunction

GRAVITY_M_S2 = 9.80665
_GYRO_CONFIG, _ACCEL_CONFIG = 27, 28
_COUNTS_DEG_S, _COUNTS_G = 131.0, 16384.0
# PS-MPU-6000A-00, 6.2: 340 counts a degree, 0 at 36.53 degrees.
_TEMPERATURE = round((25.0 - 36.53) * 340)
_SAMPLE = struct.Struct("=7h")
NOISE_DEG_S, NOISE_M_S2 = 0.05, 0.03
"""Of the part with its filter at 98 Hz (PS-MPU-6000A-00, 6.1 and 6.2), standard deviations."""


_Vector = tuple[float, float, float]


class Fault(enum.IntEnum):
    """How the IMU ceases to answer; ``HANGS`` ends when the master clocks the line by hand."""

    NONE = 0
    NO_ANSWER = 1
    SDA_LOW = 2
    SCL_LOW = 3
    HANGS = 4


@dataclass(frozen=True, slots=True)
class Motion:
    """The motion of the aircraft, in its axes: x forward, y right, z down.

    Rates in degrees per second; the specific force in m/s^2 is (0, 0, -9.81) at rest and level.
    """

    roll_rate_deg_s: float = 0.0
    pitch_rate_deg_s: float = 0.0
    yaw_rate_deg_s: float = 0.0
    force_x_m_s2: float = 0.0
    force_y_m_s2: float = 0.0
    force_z_m_s2: float = -GRAVITY_M_S2


def motion_at(
    roll_deg: float, pitch_deg: float, rates_deg_s: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> Motion:
    """Return the motion of an unaccelerated aircraft at a constant attitude."""
    roll, pitch = math.radians(roll_deg), math.radians(pitch_deg)
    return Motion(
        *rates_deg_s,
        GRAVITY_M_S2 * math.sin(pitch),
        -GRAVITY_M_S2 * math.sin(roll) * math.cos(pitch),
        -GRAVITY_M_S2 * math.cos(roll) * math.cos(pitch),
    )


class Imu:
    """The sensor, mounted x forward, y left, z up.

    ``motion`` is a ``Motion`` or a function of the time in seconds that returns one. ``bias_deg_s``
    and ``noise_deg_s`` (standard deviation), ``bias_m_s2`` and ``noise_m_s2`` disturb it; a real
    part always has noise, and one without looks frozen. ``is_frozen`` repeats the last sample;
    ``is_garbage`` sends noise over the whole range.
    """

    def __init__(self, library: ctypes.CDLL, handle: Handle, seed: int = 1) -> None:
        self._library = library
        self._handle = handle
        self._random = random.Random(f"imu {seed}")
        self._values = [0] * 7
        self._failure: Exception | None = None
        self.motion: Motion | Callable[[float], Motion] = Motion()
        self.bias_deg_s = (0.0, 0.0, 0.0)
        self.bias_m_s2 = (0.0, 0.0, 0.0)
        self.noise_deg_s = NOISE_DEG_S
        self.noise_m_s2 = NOISE_M_S2
        self.is_frozen = False
        self.is_garbage = False
        # C keeps the address alone: the object must live as long as the rig.
        self._function = SampleFunction(self._sample)
        library.rig_imu_on_sample(handle, self._function)

    def unplug(self) -> None:
        """Remove it from the bus: no acknowledge, the lines are high."""
        self._library.rig_imu_plug(self._handle, False)

    def plug(self) -> None:
        """Put it back; it restarts, asleep."""
        self._library.rig_imu_plug(self._handle, True)

    def fail(self, fault: Fault) -> None:
        self._library.rig_imu_fault(self._handle, int(fault), 0, 0, True)

    def fail_at_byte(self, byte: int, fault: Fault, *, after_transfers: int = 0) -> None:
        """Start a fault at a byte of a transfer: byte 0 is the first address after a start.

        A repeated start begins a new transfer; ``after_transfers`` of them pass undisturbed.
        """
        # The next start is counted before its bytes are.
        transfers = after_transfers + 1
        self._library.rig_imu_fault(self._handle, int(fault), byte, transfers, False)

    def mend(self) -> None:
        """End a fault; the registers keep their values."""
        self._library.rig_imu_fault(self._handle, int(Fault.NONE), 0, 0, False)

    def set_identity(self, who_am_i: int) -> None:
        """Set the value of WHO_AM_I, 0x68 in the real part."""
        self._library.rig_imu_identity(self._handle, who_am_i)

    def register(self, number: int) -> int:
        return int(self._library.rig_imu_register(self._handle, number))

    @property
    def fault(self) -> Fault:
        return Fault(self._library.rig_imu_fault_now(self._handle))

    @property
    def samples(self) -> int:
        return int(self._library.rig_imu_samples(self._handle))

    @property
    def transfers(self) -> int:
        """Return how many starts the bus has seen."""
        return int(self._library.rig_imu_transfers(self._handle))

    def raise_failure(self) -> None:
        """Raise the exception of the motion's function in the last run."""
        if self._failure is not None:
            failure, self._failure = self._failure, None
            raise failure

    def _sample(self, cycle: int, into: ctypes.c_void_p) -> None:
        # An exception cannot pass through C: it is kept and raised after the run.
        try:
            if self.is_garbage:
                self._values = [self._random.randint(-32768, 32767) for _ in range(7)]
            elif not self.is_frozen:
                self._values = self._measure(cycle / 16e6)
        except Exception as failure:  # noqa: BLE001 - whatever the caller's function raises
            self._failure = failure
        ctypes.memmove(into, _SAMPLE.pack(*self._values), _SAMPLE.size)

    def _measure(self, time_s: float) -> list[int]:
        motion = self.motion if isinstance(self.motion, Motion) else self.motion(time_s)
        gyro_count = _COUNTS_DEG_S / 2 ** (self.register(_GYRO_CONFIG) >> 3 & 3)
        accel_count = _COUNTS_G / 2 ** (self.register(_ACCEL_CONFIG) >> 3 & 3)
        p, q, r = self._spoiled(
            (motion.roll_rate_deg_s, -motion.pitch_rate_deg_s, -motion.yaw_rate_deg_s),
            self.bias_deg_s,
            self.noise_deg_s,
        )
        x, y, z = self._spoiled(
            (motion.force_x_m_s2, -motion.force_y_m_s2, -motion.force_z_m_s2),
            self.bias_m_s2,
            self.noise_m_s2,
        )
        return [
            _count(x / GRAVITY_M_S2 * accel_count),
            _count(y / GRAVITY_M_S2 * accel_count),
            _count(z / GRAVITY_M_S2 * accel_count),
            _TEMPERATURE,
            _count(p * gyro_count),
            _count(q * gyro_count),
            _count(r * gyro_count),
        ]

    def _spoiled(self, values: _Vector, bias: _Vector, noise: float) -> _Vector:
        if noise:
            gauss = self._random.gauss
            values = (
                values[0] + gauss(0.0, noise),
                values[1] + gauss(0.0, noise),
                values[2] + gauss(0.0, noise),
            )
        return values[0] + bias[0], values[1] + bias[1], values[2] + bias[2]


def _count(value: float) -> int:
    count = round(value)
    return -32768 if count < -32768 else 32767 if count > 32767 else count
