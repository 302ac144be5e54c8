"""Limits the attempts of an address to guess a key."""

from __future__ import annotations

from up.system.addresses import neighbourhood
from up.system.clock import Clock
from up.system.token_bucket import TokenBucket

ATTEMPTS_MOST = 10
ATTEMPTS_RATE_HZ = 0.1
ADDRESSES_KEPT = 1024


class KeyAttempts:
    """A bucket of wrong keys for each IPv4 address and each IPv6 /64 network.

    Right keys take nothing from it, so pages behind one address do not use up each other's. Of more
    than ``ADDRESSES_KEPT`` addresses the one that tried least recently is forgotten.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._known: dict[str, tuple[TokenBucket, float]] = {}

    def permits(self, host: str, is_right: bool) -> bool:
        """Count a key and return whether it is judged; False after too many wrong ones."""
        now_s, peer = self._clock.seconds(), neighbourhood(host)
        fresh = TokenBucket(self._clock, ATTEMPTS_RATE_HZ, ATTEMPTS_MOST), now_s
        bucket, closed_until_s = self._known.pop(peer, fresh)
        is_permitted = now_s >= closed_until_s if is_right else bucket.take()
        if not is_permitted and not is_right:
            closed_until_s = now_s + 1 / ATTEMPTS_RATE_HZ
        self._known[peer] = bucket, closed_until_s
        if len(self._known) > ADDRESSES_KEPT:
            del self._known[next(iter(self._known))]
        return is_permitted
