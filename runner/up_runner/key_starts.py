"""The quota of each key (``key quota`` of runner.yml): instances that run, and starts."""

from __future__ import annotations

from up.system.clock import Clock
from up.system.token_bucket import TokenBucket
from up_runner.config import KeyQuota
from up_runner.response import Problem


class KeyStarts:
    """Counts the starts of each key; those before a restart of the runner are forgotten."""

    def __init__(self, clock: Clock, quota: KeyQuota) -> None:
        self._clock = clock
        self._quota = quota
        self._buckets: dict[str, TokenBucket] = {}

    def count(self, key: str, running: int) -> Problem | None:
        """Count a start by a key with so many instances, or return why it is refused."""
        if running >= self._quota.instances:
            text = f"all {self._quota.instances} instances of this key are in use"
            return Problem("key_instances", text)
        limit = self._quota.starts_per_minute
        bucket = self._buckets.get(key)
        if bucket is None:
            bucket = self._buckets[key] = TokenBucket(self._clock, limit / 60, limit)
        if not bucket.take():
            return Problem("key_starts", f"this key has started {limit} instances within a minute")
        return None
