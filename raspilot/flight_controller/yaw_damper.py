"""Damps yawing without holding a yaw angle, which would need a magnetometer."""

from __future__ import annotations

from raspilot.flight_controller.cascade import OUTPUT_LIMIT, US_PER_UNIT, limited_pid
from up.flight_controller.gains import Gains

WASHOUT_S = 2.0


class YawDamper:
    """A Rate PID on the washed-out yaw rate: passes a steady turn, damps oscillation."""

    __slots__ = ("_pid", "_steady_deg_s")

    def __init__(self, gains: Gains) -> None:
        self._pid = limited_pid(gains, OUTPUT_LIMIT)
        self._steady_deg_s: float | None = None

    def tune(self, gains: Gains) -> None:
        """Set other gains."""
        self._pid.tunings = tuple(gains)

    def reset(self) -> None:
        """Reset."""
        self._pid.reset()
        self._steady_deg_s = None

    def deflection_us(self, yaw_rate_deg_s: float, dt_s: float) -> float:
        """Return the rudder deflection, us, against the oscillating part of a yaw rate."""
        if self._steady_deg_s is None:
            self._steady_deg_s = yaw_rate_deg_s
        self._steady_deg_s += (yaw_rate_deg_s - self._steady_deg_s) * min(1.0, dt_s / WASHOUT_S)
        return US_PER_UNIT * (self._pid(yaw_rate_deg_s - self._steady_deg_s, dt=dt_s) or 0.0)
