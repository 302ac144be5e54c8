"""What the tenant of this node uses, here and at the other nodes of its cluster, and its quota."""

from collections import deque
from typing import NamedTuple

from up.protocols.proxy_lines import QUOTA, HelloError, Side
from up.system.clock import Clock
from up_proxy.config import QuotaConfig
from up_proxy.registry import AircraftRegistry

HOUR_S = 3600.0
SAMPLE_S = 1.0
METER_STEP_S = 60.0
"""The hour begins and ends at such a step."""
FRESH_S = 3.0
"""A node that sends no heartbeat for longer has no connections."""
QUOTA_KEYS = {"hour_bytes": "mb_per_hour"}
"""How a kind of usage is called in proxy.yml, where it is not called alike."""
_KINDS = {Side.AIRBORNE: "aircraft", Side.GROUND: "grounds"}


class Usage(NamedTuple):
    """Connected aircraft and grounds, and bytes received from them within the last hour."""

    aircraft: int = 0
    grounds: int = 0
    hour_bytes: int = 0


class TenantQuota:
    """Counts the connections of all nodes; `limits` has those quotas that are set.

    The other nodes' counts are up to two seconds old, so connections at several nodes within that
    time may exceed a quota. The bytes of a node that has ended count until an hour after its end.
    """

    def __init__(self, clock: Clock, config: QuotaConfig) -> None:
        self._clock = clock
        found = Usage(config.aircraft, config.grounds, config.mb_per_hour * 10**6)
        self.limits = {kind: limit for kind, limit in found._asdict().items() if limit}
        self.own = Usage()
        self._others: dict[str, tuple[float, Usage]] = {}
        self._totals: deque[tuple[float, int]] = deque([(clock.seconds(), 0)])
        """Time and bytes since the start, at each step of the last hour."""
        self._seen_s: dict[str, float] = {}
        self._due_s = 0.0

    def used(self) -> Usage:
        now_s = self._clock.seconds()
        fresh = [each for at_s, each in self._others.values() if now_s - at_s <= FRESH_S]
        return Usage(
            self.own.aircraft + sum(each.aircraft for each in fresh),
            self.own.grounds + sum(each.grounds for each in fresh),
            self.own.hour_bytes + sum(each.hour_bytes for _, each in self._others.values()),
        )

    def take(self, side: Side, *, is_needed: bool = False) -> None:
        """Count a new connection. Raises HelloError with code `quota`.

        One that `is_needed` is counted, and never refused: an aircraft may be in flight.
        """
        kind = _KINDS[side]
        if self.limits:
            used = self.used()._asdict()
            for each in () if is_needed else (kind, "hour_bytes"):
                if used[each] >= self.limits.get(each, used[each] + 1):
                    name = QUOTA_KEYS.get(each, each)
                    raise HelloError(QUOTA, f"the tenant has used its quota of {name}")
        self._add(kind, 1)

    def give_back(self, side: Side) -> None:
        """Undo `take` for a connection that was refused for another reason."""
        self._add(_KINDS[side], -1)

    def was_here(self, aircraft: str) -> bool:
        """Return whether this node had the aircraft within the last hour."""
        return aircraft in self._seen_s

    def on_heartbeat(self, node: str, usage: Usage) -> None:
        self._others[node] = self._clock.seconds(), usage

    def update(self, registry: AircraftRegistry) -> None:
        """Count the connections and the bytes; at most once in SAMPLE_S."""
        now_s = self._clock.seconds()
        if now_s < self._due_s:
            return
        self._due_s = now_s + SAMPLE_S
        sessions, totals = registry.aircraft(), registry.totals()
        present = [each.name for each in sessions if not each.air_lease.is_free(now_s)]
        grounds = sum(each.own_grounds for each in sessions)
        hour_bytes = self._hour_bytes(now_s, totals.air_bytes + totals.ground_bytes)
        self.own = Usage(len(present), grounds, hour_bytes)
        recent = {name: at_s for name, at_s in self._seen_s.items() if now_s - at_s <= HOUR_S}
        self._seen_s = recent | dict.fromkeys(present, now_s)
        self._others = {n: row for n, row in self._others.items() if now_s - row[0] <= HOUR_S}

    def _add(self, kind: str, count: int) -> None:
        # At least 0: an update in between may have counted without it.
        self.own = self.own._replace(**{kind: max(0, getattr(self.own, kind) + count)})

    def _hour_bytes(self, now_s: float, total_bytes: int) -> int:
        totals = self._totals
        if now_s - totals[-1][0] >= METER_STEP_S:
            totals.append((now_s, total_bytes))
        while len(totals) > 1 and now_s - totals[1][0] >= HOUR_S:
            totals.popleft()
        return total_bytes - totals[0][1]
