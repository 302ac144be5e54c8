"""The requirements for every instance, and the delay before one is restarted."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RestartPolicy:
    """Delays and limits, in seconds; a `limit` of None never gives up."""

    delay_s: float
    max_delay_s: float
    limit: int | None
    period_s: float


@dataclass(frozen=True, slots=True)
class Policy:
    """The requirements for every instance; times in seconds.

    `exit_delay_s` None: a lost phone never stops it. `always_restart`: it may be in flight, so it
    restarts after any exit status. It is not ready before it has announced its `needed_ports`.
    """

    start_limit_s: float
    watchdog_s: float | None
    exit_delay_s: float | None
    kill_delay_s: float
    restarts: RestartPolicy
    always_restart: bool
    needed_ports: tuple[str, ...] = ()


class Backoff:
    """Counts the ends of one instance within the policy's period."""

    def __init__(self, policy: RestartPolicy) -> None:
        self._policy = policy
        self._ends: deque[float] = deque(maxlen=1000)

    @property
    def count(self) -> int:
        """Return how many ends were within the period at the last one."""
        return len(self._ends)

    def next_delay_s(self, now_s: float) -> float | None:
        """Count an end at `now_s` and return the delay before the restart, None to give up.

        An end older than the period no longer counts: the delays start again.
        """
        policy = self._policy
        while self._ends and now_s - self._ends[0] >= policy.period_s:
            self._ends.popleft()
        self._ends.append(now_s)
        if policy.limit is not None and len(self._ends) > policy.limit:
            return None
        # 2**30 periods exceed any bound; a larger exponent would only overflow.
        doublings = min(len(self._ends) - 1, 30)
        return min(policy.delay_s * 2.0**doublings, policy.max_delay_s)
