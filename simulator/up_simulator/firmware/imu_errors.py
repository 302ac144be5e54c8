"""What spoils the measurements of an IMU: noise, bias, warming up, a motor that shakes it."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

from up_rig.imu import NOISE_DEG_S, NOISE_M_S2, Motion

Vector = tuple[float, float, float]
ZERO: Vector = (0.0, 0.0, 0.0)
_PHASES = (0.0, math.pi / 2, math.pi / 4)
"""An unbalanced rotor shakes two axes a quarter of a turn apart, and the mount the third."""


@dataclass(frozen=True, slots=True)
class ImuErrors:
    """How a sensor errs; vectors are x forward, y right, z down.

    Noise is a standard deviation for each sample. ``gyro_drift_deg_s`` is what the bias changes by
    until the sensor is warm; ``warm_up_s`` is the time constant of that, from its power-on. The
    vibration is an amplitude as the sensor's own filter passes it, at full throttle and at
    ``vibration_hz``; frequency goes with the throttle, amplitude with its square, as the force of
    an unbalanced rotor does.
    """

    gyro_noise_deg_s: float = NOISE_DEG_S
    accel_noise_m_s2: float = NOISE_M_S2
    gyro_bias_deg_s: Vector = ZERO
    accel_bias_m_s2: Vector = ZERO
    gyro_drift_deg_s: Vector = ZERO
    warm_up_s: float = 60.0
    vibration_deg_s: float = 0.0
    vibration_m_s2: float = 0.0
    vibration_hz: float = 150.0


class ImuModel:
    """Turns what moves the aircraft into what its IMU measures; the same seed errs alike.

    ``errors`` may be changed in flight. ``throttle`` (0 to 1) is how fast the motor turns.
    """

    def __init__(self, errors: ImuErrors, seed: int) -> None:
        self.errors = errors
        self.throttle = 0.0
        self._random = random.Random(f"imu errors {seed}")
        self._turned = 0.0
        self._measured_s = 0.0

    def measure(self, motion: Motion, time_s: float) -> Motion:
        """Return the motion as it is measured at a time since power-on, which never falls."""
        errors = self.errors
        step_s, self._measured_s = time_s - self._measured_s, time_s
        self._turned = (self._turned + step_s * errors.vibration_hz * self.throttle) % 1.0
        warmth = 1.0 - math.exp(-time_s / errors.warm_up_s)
        shaken = [self._shake(phase) for phase in _PHASES]
        rates = (motion.roll_rate_deg_s, motion.pitch_rate_deg_s, motion.yaw_rate_deg_s)
        forces = (motion.force_x_m_s2, motion.force_y_m_s2, motion.force_z_m_s2)
        gauss = self._random.gauss
        return Motion(
            *(
                rate
                + errors.gyro_bias_deg_s[axis]
                + warmth * errors.gyro_drift_deg_s[axis]
                + errors.vibration_deg_s * shaken[axis]
                + gauss(0.0, errors.gyro_noise_deg_s)
                for axis, rate in enumerate(rates)
            ),
            *(
                force
                + errors.accel_bias_m_s2[axis]
                + errors.vibration_m_s2 * shaken[axis]
                + gauss(0.0, errors.accel_noise_m_s2)
                for axis, force in enumerate(forces)
            ),
        )

    def _shake(self, phase: float) -> float:
        return self.throttle**2 * math.sin(2 * math.pi * self._turned + phase)
