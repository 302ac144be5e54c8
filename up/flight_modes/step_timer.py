"""Measures whether a flight mode's step takes too long, on a computer that others use too."""

from __future__ import annotations

import gc
import resource
from time import perf_counter
from typing import Any

LIMIT_S = 0.02


class StepTimer:
    """Tells a step that computes or waits too long from one that the system interrupted.

    A step overruns if it took more than ``limit_s`` and either used that much processor time or
    gave up the processor by itself (it slept, or waited for a file). Time in which another program
    ran, or Python collected garbage, is not the step's.
    """

    def __init__(self, limit_s: float = LIMIT_S) -> None:
        self.limit_s = limit_s
        self.last_s = 0.0
        self._collecting_s = self._collected_s = 0.0
        gc.callbacks.append(self._on_collection)

    def close(self) -> None:
        """Stop watching the garbage collector."""
        gc.callbacks.remove(self._on_collection)

    def start(self) -> None:
        """Begin a step."""
        self._collected_s = 0.0
        self._used = resource.getrusage(resource.RUSAGE_THREAD)
        self._started_s = perf_counter()

    def is_overrun(self) -> bool:
        """Return whether the step since ``start`` took too long, and set ``last_s``."""
        self.last_s = perf_counter() - self._started_s - self._collected_s
        if self.last_s <= self.limit_s:
            return False
        used, before = resource.getrusage(resource.RUSAGE_THREAD), self._used
        processor_s = used.ru_utime + used.ru_stime - before.ru_utime - before.ru_stime
        has_waited = used.ru_nvcsw > before.ru_nvcsw
        return has_waited or processor_s - self._collected_s > self.limit_s

    def _on_collection(self, phase: str, _: dict[str, Any]) -> None:
        if phase == "start":
            self._collecting_s = perf_counter()
        else:
            self._collected_s += perf_counter() - self._collecting_s
