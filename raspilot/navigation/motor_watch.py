"""Whether the motor gives the thrust that the throttle demands."""

from __future__ import annotations

MIN_DIFFERENCE_M_S = 2.0
STOPPED_SHARE, WORKING_SHARE = 0.45, 0.6
STOPPED_FIXES, WORKING_FIXES = 3, 3


class MotorWatch:
    """Compares the estimated airspeed with two models: one with, one without the motor's thrust.

    Both are driven by the same pitch and throttle, and in cruise they differ by several m/s. The
    estimate is nearer to the one that is true; a few fixes in succession decide.
    """

    def __init__(self) -> None:
        self.is_stopped = False
        self._fixes = 0

    def fix(self, airspeed_m_s: float, powered_m_s: float, glide_m_s: float) -> bool:
        """Take the estimate and the models after a fix; return whether the verdict changed."""
        difference = powered_m_s - glide_m_s
        share = (airspeed_m_s - glide_m_s) / difference if difference > MIN_DIFFERENCE_M_S else None
        if share is None or not (
            share > WORKING_SHARE if self.is_stopped else share < STOPPED_SHARE
        ):
            self._fixes = 0
            return False
        self._fixes += 1
        if self._fixes < (WORKING_FIXES if self.is_stopped else STOPPED_FIXES):
            return False
        self.is_stopped = not self.is_stopped
        self._fixes = 0
        return True
