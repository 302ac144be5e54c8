"""Limits the answers to each sender."""

from __future__ import annotations

from collections import OrderedDict

from up.system.clock import Clock
from up.system.token_bucket import TokenBucket

MAX_ANSWERS_HZ = 256.0


class RateLimit:
    """Permits ``per_second`` answers per second to each sender; remembers ``askers`` at most.

    All senders together get `MAX_ANSWERS_HZ`: a flood of forged addresses costs bounded memory and
    bounded traffic.
    """

    def __init__(self, clock: Clock, per_second: int = 10, askers: int = 256) -> None:
        self._clock = clock
        self._per_second = per_second
        self._askers = askers
        self._all = TokenBucket(clock, MAX_ANSWERS_HZ, MAX_ANSWERS_HZ)
        self._buckets: OrderedDict[str, TokenBucket] = OrderedDict()

    def __len__(self) -> int:
        """Return how many senders are remembered."""
        return len(self._buckets)

    def permits(self, asker: str) -> bool:
        """Count a request and return whether it may be answered."""
        bucket = self._buckets.pop(asker, None)
        if bucket is None:
            bucket = TokenBucket(self._clock, self._per_second, self._per_second)
        self._buckets[asker] = bucket
        if len(self._buckets) > self._askers:
            self._buckets.popitem(last=False)
        return bucket.take() and self._all.take()
