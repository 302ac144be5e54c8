"""A timeout that is cheap to restart often."""

from __future__ import annotations

from collections.abc import Callable

from up.system.clock import Clock, Timer, cancel


class Watchdog:
    """Calls `on_expired` when `reset` was not called for `limit_s` seconds.

    `reset` only stores the time: a single timer compares it when it fires, so a thousand calls cost
    a thousand assignments. Idle until the first `reset`.
    """

    def __init__(self, clock: Clock, limit_s: float, on_expired: Callable[[], None]) -> None:
        self._clock = clock
        self._limit_s = limit_s
        self._on_expired = on_expired
        self._due_s = 0.0
        self._timer: Timer | None = None

    @property
    def running(self) -> bool:
        return self._timer is not None

    def reset(self) -> None:
        self._due_s = self._clock.seconds() + self._limit_s
        if self._timer is None:
            self._timer = self._clock.callLater(self._limit_s, self._check)

    def stop(self) -> None:
        timer, self._timer = self._timer, None
        cancel(timer)

    def _check(self) -> None:
        self._timer = None
        left_s = self._due_s - self._clock.seconds()
        if left_s > 1e-9:
            self._timer = self._clock.callLater(left_s, self._check)
        else:
            self._on_expired()
