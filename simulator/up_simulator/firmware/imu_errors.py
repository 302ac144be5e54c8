"""The measurement errors of an IMU: noise, bias, warming up, vibration by a motor."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from typing import Any, Literal

from up_rig.imu import NOISE_DEG_S, NOISE_M_S2, Motion

ImuFault = Literal["well", "frozen", "unplugged", "stuck", "garbage"]
Vector = tuple[float, float, float]
ZERO: Vector = (0.0, 0.0, 0.0)
DRAWN_BIAS_DEG_S = (2.0, 4.0)
DRAWN_DRIFT_DEG_S = 1.0
_TURN = 2.0 * math.pi


@dataclass(frozen=True, slots=True)
class ImuErrors:
    """Errors of a sensor; vectors are x forward, y right, z down.

    Noise is a standard deviation for each sample. ``gyro_drift_deg_s`` is the change of the bias
    until the sensor is warm; ``warm_up_s`` is its time constant, from power-on. The vibration is
    an amplitude behind the sensor's own filter, at full throttle and at ``vibration_hz``;
    frequency is proportional to the throttle, amplitude to its square, as the force of an
    unbalanced rotor.
    """

    gyro_noise_deg_s: float = NOISE_DEG_S
    accel_noise_m_s2: float = NOISE_M_S2
    gyro_bias_deg_s: Vector = ZERO
    accel_bias_m_s2: Vector = ZERO
    gyro_drift_deg_s: Vector = ZERO
    warm_up_s: float = 600.0
    vibration_deg_s: float = 0.0
    vibration_m_s2: float = 0.0
    vibration_hz: float = 150.0


def drawn_errors(seed: int, **known: Any) -> ImuErrors:
    """Return the errors of one individual sensor: those not ``known`` are drawn by the seed.

    An MPU6050 may read 20 deg/s at rest, and 20 deg/s more or less between -40 and 85 degrees
    Celsius: 0.16 deg/s for each degree (PS-MPU-6000A-00, 6.1). Drawn on each axis: a bias of 2 to
    4 deg/s with either sign, and a drift of up to 1 deg/s, of a sensor that becomes 6 degrees
    warmer with the time constant ``warm_up_s``.
    """
    chance = random.Random(f"imu bias {seed}")
    bias = tuple(chance.choice((-1, 1)) * chance.uniform(*DRAWN_BIAS_DEG_S) for _ in range(3))
    drift = tuple(chance.uniform(-DRAWN_DRIFT_DEG_S, DRAWN_DRIFT_DEG_S) for _ in range(3))
    return ImuErrors(**{"gyro_bias_deg_s": bias, "gyro_drift_deg_s": drift, **known})


class BoardImu:
    """The sensor of a board: it turns the aircraft's motion into measurements.

    ``motion`` holds until it is set again. ``errors`` and ``throttle``, the speed of the motor (0
    to 1), may change in flight. The same seed gives equal errors.
    """

    def __init__(self, errors: ImuErrors, seed: int) -> None:
        self.errors = errors
        self.throttle = 0.0
        self.motion = Motion()
        self.fault: ImuFault = "well"
        self._uniform = random.Random(f"imu errors {seed}").random
        self._turned = 0.0
        self._measured_s = 0.0

    def set_fault(self, fault: ImuFault) -> None:
        """Set a fault, or clear it.

        frozen: it repeats the same sample. unplugged: no answer. stuck: it holds the bus.
        garbage: it answers with random numbers.
        """
        self.fault = fault

    def measure(self, time_s: float) -> Motion:
        """Return the measured motion at a time since power-on, which never falls."""
        motion, errors = self.motion, self.errors
        p, q, r = errors.gyro_bias_deg_s
        x, y, z = errors.accel_bias_m_s2
        if errors.gyro_drift_deg_s != ZERO:
            warmth = 1.0 - math.exp(-time_s / errors.warm_up_s)
            drift_p, drift_q, drift_r = errors.gyro_drift_deg_s
            p, q, r = p + warmth * drift_p, q + warmth * drift_q, r + warmth * drift_r
        if errors.vibration_deg_s or errors.vibration_m_s2:
            shaken = self._shake(time_s)
            rate, force = errors.vibration_deg_s, errors.vibration_m_s2
            p, q, r = p + rate * shaken[0], q + rate * shaken[1], r + rate * shaken[2]
            x, y, z = x + force * shaken[0], y + force * shaken[1], z + force * shaken[2]
        self._measured_s = time_s
        gyro, accel = errors.gyro_noise_deg_s, errors.accel_noise_m_s2
        (n1, n2), (n3, n4), (n5, n6) = self._normal(), self._normal(), self._normal()
        return Motion(
            motion.roll_rate_deg_s + p + n1 * gyro,
            motion.pitch_rate_deg_s + q + n2 * gyro,
            motion.yaw_rate_deg_s + r + n3 * gyro,
            motion.force_x_m_s2 + x + n4 * accel,
            motion.force_y_m_s2 + y + n5 * accel,
            motion.force_z_m_s2 + z + n6 * accel,
        )

    def _normal(self) -> tuple[float, float]:
        """Return two numbers of the standard normal distribution (Box and Muller 1958)."""
        angle = self._uniform() * _TURN
        radius = math.sqrt(-2.0 * math.log(1.0 - self._uniform()))
        return math.cos(angle) * radius, math.sin(angle) * radius

    def _shake(self, time_s: float) -> Vector:
        # An unbalanced rotor shakes two axes a quarter of a turn apart, and its mount the third.
        turns = (time_s - self._measured_s) * self.errors.vibration_hz * self.throttle
        self._turned = (self._turned + turns) % 1.0
        strength, angle = self.throttle**2, 2 * math.pi * self._turned
        return (
            strength * math.sin(angle),
            strength * math.cos(angle),
            strength * math.sin(angle + math.pi / 4),
        )
