"""The time of a log: the wall clock at its start, and monotonic seconds since."""

from __future__ import annotations

import time
from collections.abc import Callable

JUMP_S = 60.0


class Timeline:
    """Turns the monotonic time of an entry into the log's, which no wall clock tears.

    ``now`` is the clock that entries are stamped with, ``wall_ns`` the wall clock.
    """

    def __init__(
        self,
        now: Callable[[], float] = time.perf_counter,
        wall_ns: Callable[[], int] = time.time_ns,
    ) -> None:
        self._now = now
        self._wall_ns = wall_ns
        self._origin_ns = wall_ns() - round(now() * 1e9)
        self._told_s = 0.0

    def log_ns(self, time_s: float) -> int:
        """Return the log's time, nanoseconds since 1970."""
        return max(0, self._origin_ns + int(time_s * 1e9))

    @property
    def start_unix_s(self) -> float:
        """Return the log's time of this moment, seconds since 1970."""
        return self.log_ns(self._now()) / 1e9

    def jump_s(self) -> float | None:
        """Return how far the wall clock is from the log's time, when it jumped by a minute.

        None: it did not since it was last told.
        """
        away_s = (self._wall_ns() - self.log_ns(self._now())) / 1e9
        if abs(away_s - self._told_s) < JUMP_S:
            return None
        self._told_s = away_s
        return away_s
