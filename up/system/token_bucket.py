"""How many events a link may cause: a burst, and a rate in the long run."""

from __future__ import annotations

from up.system.clock import Clock


class TokenBucket:
    """Permits ``burst`` events immediately and ``rate_hz`` a second in the long run.

    ``refused`` counts the events that were not permitted.
    """

    def __init__(self, clock: Clock, rate_hz: float, burst: float) -> None:
        self.refused = 0
        self._clock = clock
        self._rate_hz = rate_hz
        self._burst = burst
        self._tokens = burst
        self._refilled_s = clock.seconds()

    def take(self) -> bool:
        """Take a token; False: there is none, and the event is counted as refused."""
        now_s = self._clock.seconds()
        self._tokens = min(self._burst, self._tokens + (now_s - self._refilled_s) * self._rate_hz)
        self._refilled_s = now_s
        if self._tokens < 1:
            self.refused += 1
            return False
        self._tokens -= 1
        return True
