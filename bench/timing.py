"""Times short functions side by side, and judges figures by their spread."""

import gc
import math
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import repeat

Work = Callable[[], object]
NOISY = 0.1
"""A spread of more than this share of the median cannot be judged at the target."""


@dataclass(frozen=True, slots=True)
class Limit:
    """A target: at most ``value``, or at least."""

    value: float
    is_minimum: bool = False


@dataclass(frozen=True, slots=True)
class Spread:
    """The median of several rounds and their quartiles."""

    median: float
    low: float
    high: float

    @classmethod
    def of(cls, values: Sequence[float]) -> "Spread":
        if any(map(math.isnan, values)):
            return cls(math.nan, math.nan, math.nan)
        if len(values) == 1:
            return cls(values[0], -math.inf, math.inf)
        low, median, high = statistics.quantiles(values, n=4, method="inclusive")
        return cls(median, low, high)

    def meets(self, limit: Limit) -> bool | None:
        """Return whether the median meets the limit; None if the rounds are too noisy to judge."""
        is_narrow = self.high - self.low <= NOISY * abs(self.median)
        is_clear = self.low > limit.value or self.high < limit.value
        if not (is_narrow or is_clear):
            return None
        return self.median >= limit.value if limit.is_minimum else self.median <= limit.value


def rounds_ns(works: Sequence[Work], rounds: int, calls: int) -> list[list[float]]:
    """Return the CPU nanoseconds of one call of each work in each of several alternating rounds.

    The collector is off, as in the daemon; the time of the empty loop is subtracted.
    """
    found: list[list[float]] = [[] for _ in works]
    was_on = gc.isenabled()
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            floor = _loop_ns(_nothing, calls) - _CALL_NS
            for figures, work in zip(found, works, strict=True):
                figures.append(max(0.0, _loop_ns(work, calls) - floor))
    finally:
        if was_on:
            gc.enable()
    return found


_CALL_NS = 20.0
"""About the time to call an empty function: it belongs to the work, the loop does not."""


def _nothing() -> None:
    pass


def _loop_ns(work: Work, calls: int) -> float:
    began = time.process_time_ns()
    for _ in repeat(None, calls):
        work()
    return (time.process_time_ns() - began) / calls


def percentile(ordered: Sequence[float], share: float) -> float:
    """Return the value below which ``share`` (0 to 1) of the ordered values lie; NaN if empty."""
    if not ordered:
        return math.nan
    return ordered[min(len(ordered) - 1, int(len(ordered) * share))]
