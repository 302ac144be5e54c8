"""Lets the interpreter go now and then, so that control never waits long for the recorder."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

BATCH_S = 0.0003
"""The interpreter is held so long at a time."""
PAUSE_S = 0.002


class Pace:
    """Pauses between the steps of long work, whenever the time of a batch is over."""

    def __init__(self, pause: Callable[[float], object] = time.sleep) -> None:
        self._pause = pause
        self._due_s = 0.0

    def begin(self) -> None:
        """Count the time of a batch from now on."""
        self._due_s = time.perf_counter() + BATCH_S

    def step(self) -> None:
        """Pause, if it is time to."""
        if time.perf_counter() > self._due_s:
            self._pause(PAUSE_S)
            self._due_s = time.perf_counter() + BATCH_S

    def walk(self, steps: Iterable[object]) -> None:
        """Do the steps, with pauses between them."""
        self.begin()
        for _ in steps:
            self.step()

    def hurry(self) -> None:
        """Take no pause any more: the program wants to end."""
        self._pause = _no_pause


def _no_pause(seconds: float) -> None:
    """Go on at once."""
