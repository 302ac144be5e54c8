"""Whether the motor gives the thrust that the throttle demands."""

from __future__ import annotations

from raspilot.navigation.air_path import AirPoint

SIGMA_M_S2 = 0.7
"""Of one acceleration; gusts and errors of the attitude last for several of them."""
MAX_EVIDENCE, CERTAIN = 1.5, 4.0
"""Of one acceleration, and for a verdict: logarithms of a likelihood ratio."""
MAX_OFFSET_M_S2, OFFSET_S = 0.5, 20.0
SILENT_S = 2.0
DIVE_M_S2 = 1.5
"""Acceleration without thrust of a dive: it leads to airspeeds at which the drag is not known."""
SETTLING_S = 10.0
"""From the beginning of the flight, after a time without orientation, in which an attitude found
anew may be wrong, and after a dive."""


class MotorWatch:
    """Compares the acceleration along the nose with drag, climb and the thrust demanded.

    A sequential test (Page's cumulative sum): each acceleration adds how much more probable the
    other verdict makes it. Little thrust is little evidence: a motor that stops while it idles is
    noticed when the throttle opens. A constant error, of the attitude or of the drag, is learned.
    """

    def __init__(self) -> None:
        self.is_stopped = False
        self._offset_m_s2 = 0.0
        self._evidence = 0.0
        self._began: AirPoint | None = None
        self._unseen_s = -1.0  # The beginning counts as a time without orientation.
        self._time_s = float("-inf")
        self._settled_s = float("-inf")

    def is_watching(self, time_s: float) -> bool:
        """Return whether a stop would be noticed at this time."""
        return self._settled_s <= time_s <= self._time_s + SILENT_S

    def acceleration(self, forward_m_s2: float, begin: AirPoint, end: AirPoint) -> float | None:
        """Take an acceleration that was felt between two points of the air path.

        Return None, or the airspeed (m/s) that a changed verdict gives or takes.
        """
        dt_s = end.time_s - begin.time_s
        thrust = (end.thrust_m_s - begin.thrust_m_s) / dt_s
        coast = (end.coast_m_s - begin.coast_m_s) / dt_s
        rest = forward_m_s2 - coast - thrust
        passed_s, self._time_s = min(dt_s, end.time_s - self._time_s), end.time_s
        if end.unseen_s > self._unseen_s or coast > DIVE_M_S2:
            self._unseen_s = end.unseen_s
            self._settled_s = end.time_s + SETTLING_S
        if end.time_s < self._settled_s:
            self._evidence = 0.0
            return None
        if self._evidence == 0.0:
            self._began = begin
        if self._evidence == 0.0 and not self.is_stopped:
            offset = self._offset_m_s2 + (rest - self._offset_m_s2) * passed_s / OFFSET_S
            self._offset_m_s2 = max(-MAX_OFFSET_M_S2, min(MAX_OFFSET_M_S2, offset))
        missing = -thrust * (2.0 * (rest - self._offset_m_s2) + thrust) / (2.0 * SIGMA_M_S2**2)
        evidence = -missing if self.is_stopped else missing
        self._evidence += max(-MAX_EVIDENCE, min(MAX_EVIDENCE, evidence))
        self._evidence = max(0.0, self._evidence)
        if self._evidence < CERTAIN or self._began is None:
            return None
        self.is_stopped = not self.is_stopped
        self._evidence = 0.0
        changed_m_s = end.thrust_m_s - self._began.thrust_m_s
        return -changed_m_s if self.is_stopped else changed_m_s
