"""A time by which something must have happened, moved cheaply as often as it does."""

from __future__ import annotations

from collections.abc import Callable

from up.system.clock import Clock, Timer


class Deadline:
    """Calls `missed` when `touch` was not called for `limit_s` seconds.

    Touching only notes the time: the one timer looks at it when it comes, so a thousand touches
    cost a thousand assignments. Idle until the first `touch`.
    """

    def __init__(self, clock: Clock, limit_s: float, missed: Callable[[], None]) -> None:
        self._clock = clock
        self._limit_s = limit_s
        self._missed = missed
        self._due_s = 0.0
        self._timer: Timer | None = None

    @property
    def running(self) -> bool:
        """Say whether it waits for a touch."""
        return self._timer is not None

    def touch(self) -> None:
        """Begin the time anew."""
        self._due_s = self._clock.seconds() + self._limit_s
        if self._timer is None:
            self._timer = self._clock.callLater(self._limit_s, self._look)

    def stop(self) -> None:
        """Wait for nothing until the next touch."""
        timer, self._timer = self._timer, None
        if timer is not None and timer.active():
            timer.cancel()

    def _look(self) -> None:
        self._timer = None
        left_s = self._due_s - self._clock.seconds()
        if left_s > 1e-9:
            self._timer = self._clock.callLater(left_s, self._look)
        else:
            self._missed()
