"""The wind as the mean of its estimates, the certain ones counting more."""

import math

PERIOD_S = 40.0


class WindMean:
    """A mean that forgets within ``PERIOD_S``; each estimate counts by its inverse variance."""

    def __init__(self) -> None:
        self.north_m_s = self.east_m_s = 0.0
        self._weight = 0.0

    def add(self, north_m_s: float, east_m_s: float, variance: float, dt_s: float) -> None:
        weight = dt_s / max(variance, 0.01)
        self._weight = self._weight * math.exp(-dt_s / PERIOD_S) + weight
        share = weight / self._weight if self._weight > 0.0 else 1.0
        self.north_m_s += share * (north_m_s - self.north_m_s)
        self.east_m_s += share * (east_m_s - self.east_m_s)
