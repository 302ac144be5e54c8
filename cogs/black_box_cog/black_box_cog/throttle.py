"""Releases the interpreter regularly, so that control never waits long for the recorder."""

import time
from collections.abc import Callable, Iterable

BATCH_S = 0.0003
"""Maximum time without a pause."""
PAUSE_S = 0.002


class CooperativeThrottle:
    """Pauses between the steps of long work, after each such time."""

    def __init__(self, pause: Callable[[float], object] = time.sleep) -> None:
        self._pause = pause
        self._due_s = 0.0

    def begin(self) -> None:
        self._due_s = time.perf_counter() + BATCH_S

    def step(self) -> None:
        if time.perf_counter() > self._due_s:
            self._pause(PAUSE_S)
            self._due_s = time.perf_counter() + BATCH_S

    def run(self, steps: Iterable[object]) -> None:
        self.begin()
        for _ in steps:
            self.step()

    def disable(self) -> None:
        """Stop pausing: the program is ending."""
        self._pause = lambda _: None
