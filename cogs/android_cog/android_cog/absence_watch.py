"""Acts on an absence that lasts too long."""

from __future__ import annotations

from collections.abc import Callable

from up.system.clock import Clock, Timer


class AbsenceWatch:
    """Calls ``act`` once, ``delay_s`` after ``begin``, unless cancelled before."""

    def __init__(self, clock: Clock, delay_s: float, act: Callable[[], object]) -> None:
        self._clock = clock
        self._delay_s = delay_s
        self._act = act
        self._timer: Timer | None = None

    def begin(self) -> None:
        """Start waiting; idempotent."""
        if self._timer is None:
            self._timer = self._clock.callLater(self._delay_s, self._over)

    def cancel(self) -> None:
        """Stop waiting: the absence is over."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _over(self) -> None:
        self._timer = None
        self._act()
