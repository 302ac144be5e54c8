"""What the project asks of a reactor's clock, and a clock that no wall clock moves."""

import time
from collections.abc import Callable
from typing import Any, Protocol


class Timer(Protocol):
    """A call that was asked for and has not come yet; Twisted's DelayedCall is one."""

    def active(self) -> bool:
        """Say whether the call is still to come."""

    def cancel(self) -> None:
        """Take the call back; raises when it is not active."""


class Clock(Protocol):
    """Time in seconds and calls later; a Twisted reactor and `task.Clock` are such clocks."""

    def seconds(self) -> float:
        """Return the time in seconds."""

    def callLater(  # noqa: N802 - Twisted's name
        self, delay: float, callable: Callable[..., object], *args: object, **kw: object
    ) -> Timer:
        """Call `callable` after `delay` seconds."""


def use_monotonic_time(reactor: Any) -> None:
    """Let the reactor's timers follow the monotonic clock.

    Twisted's reactors read the wall clock: set back by a day, every timer waits a day longer.
    Call it in a program's main, before anything is scheduled.
    """
    reactor.seconds = time.monotonic
