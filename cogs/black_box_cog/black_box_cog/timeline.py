"""The time of a log: the wall clock at its start, and monotonic seconds since."""

import time
from collections.abc import Callable

JUMP_S = 60.0


class Timeline:
    """Converts the monotonic time of an entry to the log's, unaffected by wall clock jumps.

    ``now`` is the clock of the entries' times, ``wall_ns`` the wall clock.
    """

    def __init__(
        self,
        now: Callable[[], float] = time.perf_counter,
        wall_ns: Callable[[], int] = time.time_ns,
    ) -> None:
        self._now = now
        self._wall_ns = wall_ns
        self._origin_ns = wall_ns() - round(now() * 1e9)
        self._reported_s = 0.0

    def log_ns(self, time_s: float) -> int:
        return max(0, self._origin_ns + int(time_s * 1e9))

    @property
    def start_unix_s(self) -> float:
        """Return the log's time of this moment, seconds since 1970."""
        return self.log_ns(self._now()) / 1e9

    def jump_s(self) -> float | None:
        """Return the distance of the wall clock from the log's time after a jump of a minute.

        None without a new jump since the last report.
        """
        away_s = (self._wall_ns() - self.log_ns(self._now())) / 1e9
        if abs(away_s - self._reported_s) < JUMP_S:
            return None
        self._reported_s = away_s
        return away_s
