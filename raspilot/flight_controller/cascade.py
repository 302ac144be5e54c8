"""Two PID controllers in series: angle to rotation rate to servo (thesis 3.3.2)."""

import math

from up.commands.gains import Gains

US_PER_UNIT = 1.25
OUTPUT_LIMIT = 400.0


class Pid:
    """A PID controller whose output and integral are limited to ``limit`` in both directions.

    The derivative is on the measurement. It computes the same as simple-pid, at a third of its time
    per step, because every frame waits for five of them.
    """

    __slots__ = ("_d", "_i", "_integral", "_last", "_p", "limit")

    def __init__(self, gains: Gains, limit: float) -> None:
        self.limit = limit
        self.tune(gains)
        self.reset()

    def tune(self, gains: Gains) -> None:
        """Set other gains, keeping the integral."""
        self._p, self._i, self._d = gains

    def reset(self) -> None:
        self._integral = 0.0
        self._last: float | None = None

    def step(self, wanted: float, measured: float, dt_s: float) -> float:
        """Return the output ``dt_s`` after the last step."""
        limit = self.limit
        last = self._last
        self._last = measured
        error = wanted - measured
        integral = self._integral + self._i * error * dt_s
        if integral > limit:
            integral = limit
        elif integral < -limit:
            integral = -limit
        self._integral = integral
        output = self._p * error + integral
        if last is not None:
            output -= self._d * (measured - last) / dt_s
        if output > limit:
            return limit
        return output if output > -limit else -limit


def pitch_rate_in_turn(wanted_deg_s: float, roll_deg: float, yaw_rate_deg_s: float) -> float:
    """Return the rate about the pitch axis, deg/s, that changes pitch by ``wanted_deg_s``.

    A banked aircraft holds its nose only while it pitches with its turn: by the yaw rate times the
    tangent of the bank, which beyond 60 degrees falls to 0 at 90. Beyond 90 degrees of bank the
    result is 0, because the elevator would pull the nose down. The firmware's flight controller
    computes the same.
    """
    sine, cosine = math.sin(math.radians(roll_deg)), math.cos(math.radians(roll_deg))
    if cosine <= 0:
        return 0.0
    tangent = sine / cosine if cosine >= 0.5 else 4 * sine * cosine
    return wanted_deg_s * cosine + yaw_rate_deg_s * tangent


class Cascade:
    """Stabilize PID and Rate PID of one axis.

    The Stabilize PID turns an angle error (deg) into a wanted rate (deg/s, limited); the Rate PID
    turns the rate error into servo units of 1.25 us, limited to 400 of them (500 us). Derivatives
    are on the measurement and the limits stop the integrals. Inputs must be finite: the provider
    guarantees it. The limit of ``stabilize`` may change between two steps.
    """

    __slots__ = ("_rate", "stabilize")

    def __init__(self, rate: Gains, stabilize: Gains, rate_limit_deg_s: float) -> None:
        self.stabilize = Pid(stabilize, rate_limit_deg_s)
        self._rate = Pid(rate, OUTPUT_LIMIT)

    def tune(self, rate: Gains, stabilize: Gains) -> None:
        """Set other gains, keeping the integrals."""
        self._rate.tune(rate)
        self.stabilize.tune(stabilize)

    def reset(self) -> None:
        self._rate.reset()
        self.stabilize.reset()

    def hold_angle(
        self, wanted_deg: float, angle_deg: float, rate_deg_s: float, dt_s: float
    ) -> float:
        wanted_deg_s = self.stabilize.step(wanted_deg, angle_deg, dt_s)
        return US_PER_UNIT * self._rate.step(wanted_deg_s, rate_deg_s, dt_s)

    def hold_rate(self, wanted_deg_s: float, rate_deg_s: float, dt_s: float) -> float:
        return US_PER_UNIT * self._rate.step(wanted_deg_s, rate_deg_s, dt_s)


WASHOUT_S = 2.0


class YawDamper:
    """A Rate PID on the washed-out yaw rate: passes a steady turn, damps oscillation."""

    __slots__ = ("_pid", "_steady_deg_s")

    def __init__(self, gains: Gains) -> None:
        self._pid = Pid(gains, OUTPUT_LIMIT)
        self._steady_deg_s: float | None = None

    def tune(self, gains: Gains) -> None:
        self._pid.tune(gains)

    def reset(self) -> None:
        self._pid.reset()
        self._steady_deg_s = None

    def deflection_us(self, yaw_rate_deg_s: float, dt_s: float) -> float:
        """Return the rudder deflection, us, against the oscillating part of a yaw rate."""
        if self._steady_deg_s is None:
            self._steady_deg_s = yaw_rate_deg_s
        self._steady_deg_s += (yaw_rate_deg_s - self._steady_deg_s) * min(1.0, dt_s / WASHOUT_S)
        return US_PER_UNIT * self._pid.step(0.0, yaw_rate_deg_s - self._steady_deg_s, dt_s)
