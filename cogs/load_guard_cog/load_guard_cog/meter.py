"""The load of the machine and of this process."""

from __future__ import annotations

import time
from typing import Protocol

import psutil

_LEAST_S = 1e-3


class Meter(Protocol):
    """Measures load."""

    def load_percent(self) -> float:
        """Return the load since the last call, 0 to 100."""

    def memory_percent(self) -> float:
        """Return the share of the memory in use, 0 to 100."""


class PsutilMeter:
    """Measures with psutil; the first load after construction covers the time since then."""

    def __init__(self) -> None:
        self._looked_s = self._used_s = 0.0
        self.load_percent()

    def load_percent(self) -> float:
        """Return the greater of the machine's load and this process's share of one core."""
        machine: float = psutil.cpu_percent(interval=None)
        now_s, used_s = time.monotonic(), time.process_time()
        passed_s = max(now_s - self._looked_s, _LEAST_S)
        own = 100.0 * (used_s - self._used_s) / passed_s
        self._looked_s, self._used_s = now_s, used_s
        return min(100.0, max(machine, own))

    def memory_percent(self) -> float:
        """Return the share of the machine's memory in use."""
        used: float = psutil.virtual_memory().percent
        return used
