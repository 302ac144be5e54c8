"""A timeout that is cheap to restart often."""

from __future__ import annotations

from collections.abc import Callable

from up.system.clock import Clock, Timer


class Deadline:
    """Calls `missed` when `touch` was not called for `limit_s` seconds.

    `touch` only stores the time: a single timer compares it when it fires, so a thousand calls cost
    a thousand assignments. Idle until the first `touch`.
    """

    def __init__(self, clock: Clock, limit_s: float, missed: Callable[[], None]) -> None:
        self._clock = clock
        self._limit_s = limit_s
        self._missed = missed
        self._due_s = 0.0
        self._timer: Timer | None = None

    @property
    def running(self) -> bool:
        """Return whether it waits for a touch."""
        return self._timer is not None

    def touch(self) -> None:
        """Restart the timeout."""
        self._due_s = self._clock.seconds() + self._limit_s
        if self._timer is None:
            self._timer = self._clock.callLater(self._limit_s, self._look)

    def stop(self) -> None:
        """Stop until the next touch."""
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
