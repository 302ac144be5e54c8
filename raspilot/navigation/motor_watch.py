"""Whether the motor gives the thrust that the throttle demands."""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

from raspilot.navigation.air_path import AirPoint

VELOCITY_SD_M_S = 0.3
LATEST_FIXES, REFERENCE_FIXES = 5, 3
STOPPED_SIGMA, WORKING_SIGMA = 1.6, 1.2
MAX_GAP_S = 3.0
GUST_VARIANCE, LEAST_GUST, MOST_GUST = 0.1, 0.02, 0.5
GUST_TAU_S = 30.0


class _Seen(NamedTuple):
    """A fix: its time, the ground velocity and the nose (north + i east), the integrals."""

    time_s: float
    ground: complex
    nose: complex
    thrust_m_s: float
    coast_m_s: float


class MotorWatch:
    def __init__(self) -> None:
        self.is_stopped = False
        self._gust = GUST_VARIANCE
        self._seen: deque[_Seen] = deque(maxlen=LATEST_FIXES + REFERENCE_FIXES)

    def fix(
        self, at: AirPoint, ground: complex, nose: complex, wind: complex, wind_variance: float
    ) -> bool:
        """Take a fix's ground velocity; return whether the verdict changed."""
        seen = self._seen
        if seen and at.time_s - seen[-1].time_s > MAX_GAP_S:
            seen.clear()
        seen.append(_Seen(at.time_s, ground, nose, at.thrust_m_s, at.coast_m_s))
        rest = [
            ((each.ground - wind) * each.nose.conjugate()).real - each.thrust_m_s - each.coast_m_s
            for each in seen
        ]
        if len(rest) == seen.maxlen and not self.is_stopped:
            dt = seen[3].time_s - seen[0].time_s
            got = max(0.0, (rest[3] - rest[0]) ** 2 - 2 * VELOCITY_SD_M_S**2) / dt
            self._gust += (got - self._gust) / GUST_TAU_S
            self._gust=max(LEAST_GUST, min(MOST_GUST, self._gust))
        self.debug = []
        verdict = False
        for first in range(max(1, len(seen) - LATEST_FIXES), len(seen)):
            share, sd = self._missing(first, rest, wind_variance)
            self.debug.append((share, sd))
            if self.is_stopped:
                is_clear = 0.5 - max(0.0, share) > WORKING_SIGMA * sd
            else:
                is_clear = min(1.0, share) - 0.5 > STOPPED_SIGMA * sd
            verdict |= is_clear
        if verdict:
            self.is_stopped = not self.is_stopped
            last = seen[-1]
            seen.clear()
            seen.append(last)
        return verdict

    def _missing(
        self, first: int, rest: list[float], wind_variance: float
    ) -> tuple[float, float]:
        """Return the missing share of the thrust since the fix before ``first``, and its sd."""
        seen = self._seen
        before, last = seen[first - 1], seen[-1]
        begin = max(0, first - REFERENCE_FIXES)
        reference = sum(rest[begin:first]) / (first - begin)
        stop_m_s = 0.5 * (before.thrust_m_s + seen[first].thrust_m_s)
        expected = [seen[i].thrust_m_s - stop_m_s for i in range(first, len(seen))]
        total, squares = sum(expected), sum(each * each for each in expected)
        if squares < 1e-6:
            return 0.5, 1.0
        missing = sum(
            each * (reference - rest[i]) for i, each in enumerate(expected, first)
        )
        noise = VELOCITY_SD_M_S**2
        common = noise / (first - begin)
        common += G_FACTOR * self._gust * (last.time_s - before.time_s)
        common += wind_variance * abs(last.nose - before.nose) ** 2
        return missing / squares, math.sqrt(noise / squares + common * (total / squares) ** 2)
G_FACTOR = 1.0
