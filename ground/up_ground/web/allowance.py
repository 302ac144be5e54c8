"""How often something may happen: now and then many times, on the average not."""

from __future__ import annotations

from up.system.clock import Clock


class Allowance:
    """``most`` times at once, and ``rate_hz`` times a second in the long run."""

    def __init__(self, clock: Clock, rate_hz: float, most: float) -> None:
        self._clock = clock
        self._rate_hz = rate_hz
        self._most = most
        self._left = most
        self._counted_s = clock.seconds()

    def take(self) -> bool:
        """Say whether it may happen once more, and count it."""
        now_s = self._clock.seconds()
        self._left = min(self._most, self._left + (now_s - self._counted_s) * self._rate_hz)
        self._counted_s = now_s
        if self._left < 1:
            return False
        self._left -= 1
        return True

    def give_back(self) -> None:
        """Count one less."""
        self._left += 1
