"""Whether the aircraft comes nearer to home."""

from __future__ import annotations

STEP_M = 10.0
"""How much nearer counts: more than the position wanders in a minute."""


class ProgressWatch:
    """Remembers the nearest distance and when it was reached."""

    def __init__(self) -> None:
        self._nearest_m: float | None = None
        self._since_s = 0.0

    def stalled_s(self, now_s: float, away_m: float | None) -> float:
        """Return for how long the distance has not become less; None: no matter now."""
        if away_m is None:
            self._nearest_m = None
            return 0.0
        if self._nearest_m is None or away_m < self._nearest_m - STEP_M:
            self._nearest_m, self._since_s = away_m, now_s
        return now_s - self._since_s
