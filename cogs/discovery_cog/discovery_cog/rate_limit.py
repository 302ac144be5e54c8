"""How often each asker is answered."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass

from up.system.clock import Clock

WINDOW_S = 1.0


@dataclass(slots=True)
class _Window:
    began_s: float
    answers: int


class RateLimit:
    """Permits ``per_second`` answers a second to each asker, and remembers ``askers`` at most.

    While that many asked within the last second, new ones are not answered: a flood of invented
    addresses costs bounded memory and bounded traffic.
    """

    def __init__(self, clock: Clock, per_second: int = 10, askers: int = 256) -> None:
        self._clock = clock
        self._per_second = per_second
        self._askers = askers
        self._windows: OrderedDict[str, _Window] = OrderedDict()

    def __len__(self) -> int:
        """Return how many askers are remembered."""
        return len(self._windows)

    def permits(self, asker: str) -> bool:
        """Count a question and return whether it may be answered."""
        now_s = self._clock.seconds()
        window = self._windows.get(asker)
        if window is None or now_s - window.began_s >= WINDOW_S:
            self._forget(now_s)
            if asker not in self._windows and len(self._windows) >= self._askers:
                return False
            self._windows[asker] = window = _Window(now_s, 0)
            self._windows.move_to_end(asker)
        if window.answers >= self._per_second:
            return False
        window.answers += 1
        return True

    def _forget(self, now_s: float) -> None:
        while self._windows:
            oldest = next(iter(self._windows.values()))
            if now_s - oldest.began_s < WINDOW_S:
                return
            self._windows.popitem(last=False)
