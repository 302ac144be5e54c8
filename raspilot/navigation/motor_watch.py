"""Whether the motor gives the thrust that the throttle demands."""

import math
from copy import copy

from raspilot.navigation.air_path import AirPoint
from raspilot.navigation.limits import limited

NOISE_M_S2 = 0.25
"""Standard deviation of one acceleration against its model, without the slow error."""
OFFSET_M_S2, OFFSET_S = 0.3, 20.0
"""Standard deviation and correlation time of the slow error: of attitude, drag and wind."""
FIRST_OFFSET_M_S2 = 0.7
"""When a flight begins: the take-off's own acceleration has tilted the board's horizon."""
MAX_DEVIATIONS = 3.0
"""By which one acceleration changes the slow error, in standard deviations."""
MAX_EVIDENCE, CERTAIN = 1.5, 4.0
"""Of one acceleration, and for a verdict: logarithms of a likelihood ratio."""
SILENT_S = 2.0
DIVE_M_S2, DIVE_S = 1.5, 1.0
"""Acceleration without thrust of a dive, and its least time: it leads to airspeeds at which the
drag is not known. A descent at idle pushes as hard for half a second."""
SETTLING_S = 10.0
"""From the beginning of the flight, after a time without orientation, in which an attitude found
anew may be wrong, and after a dive."""


class SlowError:
    """What an acceleration leaves if the motor is as supposed: a Kalman filter of one state."""

    def __init__(self) -> None:
        self._m_s2 = 0.0
        self._variance = FIRST_OFFSET_M_S2**2

    def take(self, rest_m_s2: float, passed_s: float) -> float:
        """Take what one acceleration leaves, and return the logarithm of its likelihood."""
        kept = math.exp(-passed_s / OFFSET_S)
        self._m_s2 *= kept
        self._variance += (OFFSET_M_S2**2 - self._variance) * (1.0 - kept**2)
        variance = self._variance + NOISE_M_S2**2
        surprise_m_s2 = rest_m_s2 - self._m_s2
        limit_m_s2 = MAX_DEVIATIONS * math.sqrt(variance)
        gain = self._variance / variance
        self._m_s2 += gain * limited(surprise_m_s2, -limit_m_s2, limit_m_s2)
        self._variance *= 1.0 - gain
        return -0.5 * (surprise_m_s2**2 / variance + math.log(variance))


class MotorWatch:
    """Compares the acceleration along the nose with drag, climb and the thrust demanded.

    A sequential test (Page's cumulative sum) of two suppositions, that the verdict holds and that
    it does not any more. Each learns its own slow error, and each acceleration adds how much more
    probable the second makes it. Little thrust is little evidence: a motor that stops while it
    idles is noticed when the throttle opens. An error that grows slowly is not evidence.
    """

    def __init__(self) -> None:
        self.is_stopped = False
        self._error = self._error_if_changed = SlowError()
        self._evidence = 0.0
        self._began: AirPoint | None = None
        self._dived_s = 0.0
        self._unseen_s = -1.0  # The beginning counts as a time without orientation.
        self._time_s = float("-inf")
        self._settled_s = float("-inf")

    def is_watching(self, time_s: float) -> bool:
        return self._settled_s <= time_s <= self._time_s + SILENT_S

    def acceleration(self, forward_m_s2: float, begin: AirPoint, end: AirPoint) -> float | None:
        """Take an acceleration that was felt between two points of the air path.

        Return None, or the airspeed (m/s) that a changed verdict gives or takes.
        """
        dt_s = end.time_s - begin.time_s
        thrust = (end.thrust_m_s - begin.thrust_m_s) / dt_s
        coast = (end.coast_m_s - begin.coast_m_s) / dt_s
        rest = forward_m_s2 - coast
        passed_s, self._time_s = min(dt_s, end.time_s - self._time_s), end.time_s
        self._dived_s = self._dived_s + passed_s if coast > DIVE_M_S2 else 0.0
        if end.unseen_s > self._unseen_s or self._dived_s >= DIVE_S:
            self._unseen_s = end.unseen_s
            self._settled_s = end.time_s + SETTLING_S
        given, if_changed = (0.0, thrust) if self.is_stopped else (thrust, 0.0)
        if self._evidence == 0.0:
            self._began, self._error_if_changed = begin, copy(self._error)
        held = self._error.take(rest - given, passed_s)
        evidence = self._error_if_changed.take(rest - if_changed, passed_s) - held
        if end.time_s < self._settled_s:
            self._evidence = 0.0
            return None
        self._evidence += limited(evidence, -MAX_EVIDENCE, MAX_EVIDENCE)
        self._evidence = max(0.0, self._evidence)
        if self._evidence < CERTAIN or self._began is None:
            return None
        self.is_stopped = not self.is_stopped
        self._error = self._error_if_changed
        self._evidence = 0.0
        changed_m_s = end.thrust_m_s - self._began.thrust_m_s
        return -changed_m_s if self.is_stopped else changed_m_s
