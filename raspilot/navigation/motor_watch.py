"""Whether the motor gives the thrust that the throttle demands."""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

from raspilot.navigation.air_path import AirPoint

VELOCITY_SD_M_S = 0.3
LATEST_FIXES, REFERENCE_FIXES = 5, 3
"""A stop is looked for between the latest fixes; the ones before it are what it is compared to."""
STOPPED_SIGMA, WORKING_SIGMA = 1.4, 1.0
"""How certain it is that more, or less, than half of the thrust is missing."""
MAX_GAP_S = 3.0
SETTLING_S = 10.0
"""After a time without orientation: an attitude found anew may be wrong, as a climb it is power."""
GUSTS, LEAST_GUSTS, MOST_GUSTS = 0.1, 0.02, 0.5
"""Variance (m2/s2) that gusts add to the ground velocity along the nose each second."""
GUSTS_TAU_S = 30.0
MAX_FACTOR = 1.4
"""A glide that is faster than its model by this factor is none."""


class _Seen(NamedTuple):
    """A fix: its time, the ground velocity and the nose (north + i east), the integrals."""

    time_s: float
    ground: complex
    nose: complex
    thrust_m_s: float
    coast_m_s: float


class MotorWatch:
    """Compares the ground velocity along the nose with the thrust that the throttle demands.

    A downdraught takes height but no speed; a stopped motor takes speed first. For each of the
    latest fixes, as the first one after a stop, the share of the thrust that is missing since then
    is estimated. Its uncertainty comes from the receiver, from the wind where the nose has turned,
    and from gusts, whose strength is learned: in turbulence a verdict takes more thrust or time.
    """

    def __init__(self) -> None:
        self.is_stopped = False
        self._gusts = GUSTS
        self._unseen_s = 0.0
        self._settled_s = -math.inf
        self._seen: deque[_Seen] = deque(maxlen=LATEST_FIXES + REFERENCE_FIXES)

    def fix(
        self,
        at: AirPoint,
        ground: complex,
        nose: complex,
        wind: complex,
        wind_variance: float,
        factor: float,
    ) -> bool:
        """Take a fix's ground velocity; return whether the verdict changed.

        ``factor`` is the measured airspeed over that of the model.
        """
        seen = self._seen
        if at.unseen_s > self._unseen_s:
            self._unseen_s = at.unseen_s
            self._settled_s = at.time_s + SETTLING_S
        if at.time_s < self._settled_s:
            seen.clear()
            return False
        if seen and at.time_s - seen[-1].time_s > MAX_GAP_S:
            seen.clear()
        seen.append(_Seen(at.time_s, ground, nose, at.thrust_m_s, at.coast_m_s))
        # What thrust, drag and climb do not explain: constant, and falling after a stop.
        rest = [
            ((each.ground - wind) * each.nose.conjugate()).real - each.thrust_m_s - each.coast_m_s
            for each in seen
        ]
        self._learn_gusts(rest)
        if not self._is_contradicted(rest, wind_variance, factor):
            return False
        self.is_stopped = not self.is_stopped
        while len(seen) > 1:
            seen.popleft()
        return True

    def _learn_gusts(self, rest: list[float]) -> None:
        """Learn from the oldest fixes, before a stop that may have happened since."""
        seen = self._seen
        if self.is_stopped or len(rest) < LATEST_FIXES + REFERENCE_FIXES:
            return
        last = REFERENCE_FIXES
        found = (rest[last] - rest[0]) ** 2 - 2.0 * VELOCITY_SD_M_S**2
        found = max(0.0, found) / (seen[last].time_s - seen[0].time_s)
        gusts = self._gusts + (found - self._gusts) / GUSTS_TAU_S
        self._gusts = max(LEAST_GUSTS, min(MOST_GUSTS, gusts))

    def _is_contradicted(self, rest: list[float], wind_variance: float, factor: float) -> bool:
        if self.is_stopped and factor > MAX_FACTOR:
            return True
        for first in range(max(1, len(rest) - LATEST_FIXES), len(rest)):
            share, sd = self._missing(first, rest, wind_variance)
            # A gust takes more than the thrust; a stop does not.
            share = max(0.0, min(1.0, share))
            if self.is_stopped:
                if 0.5 - share > WORKING_SIGMA * sd:
                    return True
            elif share - 0.5 > STOPPED_SIGMA * sd:
                return True
        return False

    def _missing(self, first: int, rest: list[float], wind_variance: float) -> tuple[float, float]:
        """Return the share of the thrust that is missing since before ``first``, and its sd."""
        seen = self._seen
        before, last = seen[first - 1], seen[-1]
        begin = max(0, first - REFERENCE_FIXES)
        reference = sum(rest[begin:first]) / (first - begin)
        # The motor stopped at any time within the first interval.
        stop_m_s = 0.5 * (before.thrust_m_s + seen[first].thrust_m_s)
        thrust = [seen[index].thrust_m_s - stop_m_s for index in range(first, len(seen))]
        squares = sum(each * each for each in thrust)
        if squares < 1e-6:
            return 0.5, math.inf
        missing = sum(
            each * (reference - found) for each, found in zip(thrust, rest[first:], strict=True)
        )
        noise = VELOCITY_SD_M_S**2
        common = noise / (first - begin) + self._gusts * (last.time_s - before.time_s)
        common += wind_variance * abs(last.nose - before.nose) ** 2
        total = sum(thrust)
        return missing / squares, math.sqrt(noise / squares + common * (total / squares) ** 2)
