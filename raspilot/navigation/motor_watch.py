"""Whether the motor gives the thrust that the throttle demands."""

from __future__ import annotations

STOPPED_EVIDENCE, WORKING_EVIDENCE = 6.0, 6.0
MAX_EVIDENCE = 12.0
MIN_THRUST_M_S = 0.3
"""Airspeed given between two fixes below which they prove nothing."""
GUST_M_S = 0.7
"""Change of the wind within a second that does not come from the motor, standard deviation."""


class MotorWatch:
    """A cumulative likelihood ratio of two hypotheses: the motor works, or it has stopped.

    A stopped motor lets the aircraft lose, between two fixes, the airspeed that the model has
    added for the thrust.
    """

    def __init__(self) -> None:
        self.is_stopped = False
        self._evidence = 0.0

    def fix(self, faster_m_s: float, thrust_m_s: float, deviation_m_s: float, dt_s: float) -> bool:
        """Take how much faster along the nose the ground velocity is than expected.

        ``thrust_m_s`` is the airspeed that a working motor gives between the two fixes;
        ``deviation_m_s`` the uncertainty of the difference. Return whether the verdict changed.
        """
        if thrust_m_s < MIN_THRUST_M_S:
            self._evidence = max(0.0, self._evidence - 0.5)
            return False
        variance = deviation_m_s**2 + GUST_M_S**2 * dt_s
        sign = 1.0 if self.is_stopped else -1.0
        # log of p(error | the other verdict) / p(error | the present one)
        ratio = (sign * faster_m_s * thrust_m_s - 0.5 * thrust_m_s**2) / variance
        self._evidence = min(MAX_EVIDENCE, max(0.0, self._evidence + ratio))
        needed = WORKING_EVIDENCE if self.is_stopped else STOPPED_EVIDENCE
        if self._evidence < needed:
            return False
        self.is_stopped = not self.is_stopped
        self._evidence = 0.0
        return True

    def reset(self) -> None:
        self.is_stopped = False
        self._evidence = 0.0
