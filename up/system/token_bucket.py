"""Limits the events of a link: a burst, and a long-term rate."""

from typing import Protocol


class _Time(Protocol):
    def seconds(self) -> float:
        """Return the time in seconds."""


class TokenBucket:
    """Permits ``burst`` events immediately and ``rate_hz`` per second in the long term.

    ``refused`` counts the refused events.
    """

    def __init__(self, clock: _Time, rate_hz: float, burst: float) -> None:
        self.refused = 0
        self._clock = clock
        self._rate_hz = rate_hz
        self._burst = burst
        self._tokens = burst
        self._refilled_s = clock.seconds()

    def take(self) -> bool:
        """Take a token; without one, return False and count the event as refused."""
        now_s = self._clock.seconds()
        self._tokens = min(self._burst, self._tokens + (now_s - self._refilled_s) * self._rate_hz)
        self._refilled_s = now_s
        if self._tokens < 1:
            self.refused += 1
            return False
        self._tokens -= 1
        return True
