"""Measures whether a flight mode's step takes too long, on a computer that others use too."""

import gc
import resource
from time import perf_counter
from typing import Any

AGAIN_S = 1.0


class _Collections:
    """The time that Python has spent collecting garbage; counted once for the whole process."""

    total_s = 0.0
    began_s = 0.0

    @classmethod
    def note(cls, phase: str, _: dict[str, Any]) -> None:
        if phase == "start":
            cls.began_s = perf_counter()
        else:
            cls.total_s += perf_counter() - cls.began_s


class StepTimer:
    """Tells a step that computes or waits too long from one that the system interrupted.

    A step overruns if it took more than its budget and used that much processor time, or, for the
    second time within AGAIN_S, gave up the processor (it slept, or waited for a file): once it may
    be Python's lock, held by a thread that the system interrupted. Time in which another program
    ran, or Python collected garbage, is not the step's.
    """

    def __init__(self) -> None:
        self.last_s = 0.0
        self._waited_at_s = float("-inf")
        if _Collections.note not in gc.callbacks:
            gc.callbacks.append(_Collections.note)

    def start(self) -> None:
        self._collected_s = _Collections.total_s
        self._used = resource.getrusage(resource.RUSAGE_THREAD)
        self._started_s = perf_counter()

    def is_overrun(self, budget_s: float) -> bool:
        """Return whether the step since ``start`` took too long, and set ``last_s``."""
        collected_s = _Collections.total_s - self._collected_s
        self.last_s = perf_counter() - self._started_s - collected_s
        if self.last_s <= budget_s:
            return False
        used, before = resource.getrusage(resource.RUSAGE_THREAD), self._used
        processor_s = used.ru_utime + used.ru_stime - before.ru_utime - before.ru_stime
        if processor_s - collected_s > budget_s:
            return True
        if used.ru_nvcsw == before.ru_nvcsw:
            return False
        is_again = self._started_s - self._waited_at_s < AGAIN_S
        self._waited_at_s = self._started_s
        return is_again
