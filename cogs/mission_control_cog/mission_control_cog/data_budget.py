"""What the uplink costs, and how often and how much it may send."""

from collections import deque

WINDOW_S = 60.0
"""The rate is the mean of this time."""
SLOWEST_S = 1.0
"""A frame leaves after this time whatever the budget: attitude and alarms come last to degrade."""
USEFUL_HZ = 4.0
"""Below this rate the frames get less detail before there are fewer of them."""
HOLDS_S = (0.0, 1.0, 4.0)
"""Levels of detail: how old everything but attitude, alarms and events may be in a frame."""
_RETRY_S = 30.0
_MARGIN = 1.1
_SHARE = 0.99
"""Share of the limit that is spent: what a counter has not yet seen must not exceed it."""
_BURST_S = 2.0
_LEVEL_S = 2.0
_HOUR_S = 3600.0
_MB = 1e6


class DataBudget:
    """Counts the bytes of a link, and spends no more than its limit in the mean.

    Frames leave while there is credit: the limit fills it, all that the link sends and receives
    takes from it. If it suffices for less than `USEFUL_HZ` frames, they get less detail first.
    """

    def __init__(self, limit_mb_per_hour: float | None, now_s: float) -> None:
        self.total_bytes = 0
        self.left_out = 0
        self.level = 0
        self._is_low = False
        self._limit = (
            None if limit_mb_per_hour is None else limit_mb_per_hour * _SHARE * _MB / _HOUR_S
        )
        self._credit = 0.0
        self._now_s = self._sent_s = self._level_s = now_s
        self._level_bytes = self._level_frames = 0
        self._costs: dict[int, tuple[float, float]] = {}
        self._history: deque[tuple[float, int]] = deque([(now_s, 0)])

    @property
    def hold_s(self) -> float:
        """Return how old what is neither attitude nor alarm may be in a frame."""
        return HOLDS_S[self.level]

    @property
    def mb(self) -> float:
        return self.total_bytes / _MB

    @property
    def mb_per_hour(self) -> float:
        """Return the mean rate of the last minute."""
        (began_s, began), (now_s, now) = self._history[0], self._history[-1]
        return 0.0 if now_s <= began_s else (now - began) / _MB / (now_s - began_s) * _HOUR_S

    def count(self, more_bytes: int, now_s: float) -> None:
        """Take what the link has sent and received since the last call."""
        self.total_bytes += more_bytes
        self._level_bytes += more_bytes
        if now_s - self._history[-1][0] >= 1.0:
            self._history.append((now_s, self.total_bytes))
            while now_s - self._history[0][0] > WINDOW_S:
                self._history.popleft()
        if self._limit is not None:
            burst = self._limit * _BURST_S
            credit = self._credit + self._limit * (now_s - self._now_s) - more_bytes
            self._credit = max(-5 * burst, min(burst, credit))
        self._now_s = now_s

    def permits(self, now_s: float, *, is_urgent: bool = False) -> bool:
        """Return whether a frame may leave now; without permission it counts as left out.

        A frame with an alarm or an event is urgent: it may use what the next ones would.
        """
        if self._limit is not None and now_s - self._sent_s < SLOWEST_S:
            least = -self._limit * _BURST_S if is_urgent else 0.0
            if self._credit < least:
                self.left_out += 1
                return False
        self._sent_s = now_s
        self._level_frames += 1
        if self._limit is not None and now_s - self._level_s >= _LEVEL_S:
            self._choose_level(now_s, self._limit)
        return True

    def _choose_level(self, now_s: float, limit: float) -> None:
        # At least a byte: without a link, or a kernel that counts, there are none.
        cost = max(1, self._level_bytes) / self._level_frames
        self._costs[self.level] = (cost, now_s)
        was_low, self._is_low = self._is_low, limit / cost < USEFUL_HZ
        if self._is_low:
            # Twice in succession: a handshake or a session is paid for once.
            self.level = min(self.level + was_low, len(HOLDS_S) - 1)
            self._is_low = not was_low
        elif self.level:
            above, then_s = self._costs.get(self.level - 1, (cost, 0.0))
            if limit / above > USEFUL_HZ * _MARGIN or now_s - then_s > _RETRY_S:
                self.level -= 1
        self._level_s, self._level_bytes, self._level_frames = now_s, 0, 0
