"""Times short functions side by side."""

import gc
import math
import time
from collections.abc import Callable, Sequence
from itertools import repeat

Work = Callable[[], object]


def best_ns(works: Sequence[Work], rounds: int, calls: int) -> list[float]:
    """Return the nanoseconds of one call of each, the best of several rounds in turns.

    The collector waits meanwhile, as it does in the daemon; what the empty loop takes is taken
    off.
    """
    best = [math.inf] * len(works)
    empty = math.inf
    was_on = gc.isenabled()
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            empty = min(empty, _loop_ns(_nothing, calls))
            for index, work in enumerate(works):
                best[index] = min(best[index], _loop_ns(work, calls))
    finally:
        if was_on:
            gc.enable()
    floor = empty - _CALL_NS
    return [max(0.0, each - floor) for each in best]


_CALL_NS = 20.0
"""About what calling an empty function takes: it belongs to the work, the loop does not."""


def _nothing() -> None:
    pass


def _loop_ns(work: Work, calls: int) -> float:
    began = time.perf_counter_ns()
    for _ in repeat(None, calls):
        work()
    return (time.perf_counter_ns() - began) / calls


def percentile(ordered: Sequence[float], share: float) -> float:
    """Return the value below which ``share`` (0 to 1) of the ordered values lie; NaN of none."""
    if not ordered:
        return math.nan
    return ordered[min(len(ordered) - 1, int(len(ordered) * share))]
