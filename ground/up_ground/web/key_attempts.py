"""How often an address may try keys."""

from __future__ import annotations

from up.system.addresses import neighbourhood
from up.system.clock import Clock
from up_ground.web.allowance import Allowance

ATTEMPTS_MOST = 10
ATTEMPTS_RATE_HZ = 0.1
ADDRESSES_KEPT = 1024


class KeyAttempts:
    """An allowance of wrong keys for each IPv4 address and each IPv6 /64 network.

    Right keys cost nothing, so pages behind one address do not use up each other's. Of more than
    ``ADDRESSES_KEPT`` addresses the one that tried least recently is forgotten.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._allowances: dict[str, Allowance] = {}

    def permits(self, host: str, is_right: bool) -> bool:
        """Count a key; False: too many wrong ones came, and it must not matter what it was."""
        peer = neighbourhood(host)
        allowance = self._allowances.pop(peer, None)
        if allowance is None:
            allowance = Allowance(self._clock, ATTEMPTS_RATE_HZ, ATTEMPTS_MOST)
        self._allowances[peer] = allowance
        if len(self._allowances) > ADDRESSES_KEPT:
            del self._allowances[next(iter(self._allowances))]
        is_permitted = allowance.take()
        if is_permitted and is_right:
            allowance.give_back()
        return is_permitted
