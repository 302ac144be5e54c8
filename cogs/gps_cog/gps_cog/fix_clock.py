"""The time of fixes by the clock of this program."""

import math

from up.quick_dataclass import dataclass

DRIFT = 1e-4
"""How fast the program's clock may run apart from the satellites'."""
EARLY_S, LATE_S = 0.3, 1.5
"""A fix that arrives earlier or later than the others is not believed."""
NEW_CLOCK_FIXES = 5


@dataclass(frozen=True, slots=True)
class _Arrival:
    stamp_s: float
    now_s: float


class FixClock:
    """Finds when a fix was taken: ``age_s`` is its age on arrival.

    The receiver's clock and the monotonic one have no common zero. The fix that was quickest is
    ``delay_s`` old on arrival, the others as much older as they took longer; so the jitter of the
    line and a busy program do not move a fix. A stamp that does not follow from the last is
    rejected, until ``NEW_CLOCK_FIXES`` in succession follow from each other: the receiver's clock
    was set. ``period_s`` is after which the receiver's clock begins again; 0: never.
    """

    def __init__(self, delay_s: float, period_s: float = 0.0) -> None:
        self._delay_s = delay_s
        self._period_s = period_s
        self._last: _Arrival | None = None
        self._rejected: _Arrival | None = None
        self._rejections = 0
        self._extra_s = 0.0

    def age_s(self, stamp_s: float, now_s: float) -> float | str:
        """Return the age of a fix that arrives now, or why it is rejected.

        ``repeated``: not after the last fix. ``past``, ``future``: the stamp is beside the clock.
        """
        arrival = _Arrival(stamp_s, now_s)
        if self._last is None:
            return self._begin(arrival)
        passed_s, waited_s = self._between(self._last, arrival)
        # How much more this fix was delayed than the quickest, which is forgotten by the drift.
        extra_s = self._extra_s + waited_s - passed_s - DRIFT * waited_s
        if -EARLY_S <= extra_s <= LATE_S and passed_s > 0.0:
            self._last, self._extra_s, self._rejected = arrival, max(0.0, extra_s), None
            return self._extra_s + self._delay_s
        if self._is_new_clock(arrival):
            return self._begin(arrival)
        if passed_s <= 0.0 and extra_s <= LATE_S:
            return "repeated"
        return "future" if extra_s < 0.0 else "past"

    def _between(self, then: _Arrival, now: _Arrival) -> tuple[float, float]:
        """Return how much time has passed by the receiver's clock, and by this program's."""
        passed_s = now.stamp_s - then.stamp_s
        if self._period_s:
            passed_s = math.remainder(passed_s, self._period_s)
        return passed_s, now.now_s - then.now_s

    def _is_new_clock(self, arrival: _Arrival) -> bool:
        before, self._rejected = self._rejected, arrival
        if before is None:
            self._rejections = 1
            return False
        passed_s, waited_s = self._between(before, arrival)
        follows = passed_s > 0.0 and abs(passed_s - waited_s) < EARLY_S
        self._rejections = self._rejections + 1 if follows else 1
        return self._rejections >= NEW_CLOCK_FIXES

    def _begin(self, arrival: _Arrival) -> float:
        self._last, self._extra_s, self._rejected = arrival, 0.0, None
        return self._delay_s
