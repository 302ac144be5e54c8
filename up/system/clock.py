"""The part of a reactor's clock that the project uses, and a monotonic clock for reactors."""

import time
from collections.abc import Callable
from typing import Any, Protocol


class Timer(Protocol):
    """A scheduled call; Twisted's DelayedCall is one."""

    def active(self) -> bool:
        """Return whether the call is still pending."""

    def cancel(self) -> None:
        """Cancel the call; raises when it is not active."""


class Clock(Protocol):
    """Time in seconds and delayed calls; a Twisted reactor and `task.Clock` are such clocks."""

    def seconds(self) -> float:
        """Return the time in seconds."""

    def callLater(  # noqa: N802 - Twisted's name
        self, delay: float, callable: Callable[..., object], *args: object, **kw: object
    ) -> Timer:
        """Call `callable` after `delay` seconds."""


def cancel(*timers: Timer | None) -> None:
    """Cancel the timers that are still pending."""
    for timer in timers:
        if timer is not None and timer.active():
            timer.cancel()


def use_monotonic_time(reactor: Any) -> None:
    """Make the reactor's timers use the monotonic clock.

    Twisted's reactors read the wall clock: if it is set back by a day, every timer waits a day
    longer. Call this in a program's main, before scheduling anything.
    """
    reactor.seconds = time.monotonic
