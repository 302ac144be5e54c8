"""SIGTERM and SIGHUP cause the same orderly end as Ctrl-C."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
AGAIN_S = 1.0
FIRST_STATUS = 128
Handler = Callable[[int, FrameType | None], object]


class Ending:
    """The first signal received."""

    def __init__(self) -> None:
        self._number: int | None = None
        self._heard_s = 0.0

    def hear(self, number: int, _frame: object) -> None:
        """Raise KeyboardInterrupt.

        Signals within a second count as one: a terminal that closes sends two, from the kernel
        and from the shell, and the second must not disturb the orderly end.
        """
        now_s = time.monotonic()
        if self._number is None:
            self._number = number
        elif now_s - self._heard_s < AGAIN_S:
            return
        self._heard_s = now_s
        raise KeyboardInterrupt

    def status(self, status: int) -> int:
        """Return the exit status: 128 plus the signal, as in a shell, after a signal."""
        return status if self._number is None or status == 0 else FIRST_STATUS + self._number


@contextmanager
def ending_in_order() -> Iterator[Ending]:
    """Make each of the signals raise KeyboardInterrupt, except ignored ones (``nohup``)."""
    ending = Ending()
    before = {number: signal.getsignal(number) for number in SIGNALS}
    for number, handler in before.items():
        if handler != signal.SIG_IGN:
            signal.signal(number, ending.hear)
    try:
        yield ending
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


class Interrupt:
    """Whether a signal has requested the end."""

    def __init__(self) -> None:
        self.is_asked = False

    def look(self) -> None:
        """Raise KeyboardInterrupt here when it was."""
        if self.is_asked:
            raise KeyboardInterrupt


@contextmanager
def ending_between_steps() -> Iterator[Interrupt]:
    """Record the signals, to be checked between steps; a second Ctrl-C ends in any place.

    A KeyboardInterrupt from Python could arise inside a call from C, which would swallow it.
    Signals without a handler are left alone.
    """
    interrupt = Interrupt()
    before: dict[int, Handler] = {}

    def note(number: int, frame: FrameType | None) -> None:
        is_second, interrupt.is_asked = interrupt.is_asked, True
        with suppress(KeyboardInterrupt):
            before[number](number, frame)
            return
        if is_second and number == signal.SIGINT:
            raise KeyboardInterrupt

    for number in SIGNALS:
        handler = signal.getsignal(number)
        if callable(handler):
            before[number] = handler
            signal.signal(number, note)
    try:
        yield interrupt
    finally:
        for heard, handler in before.items():
            signal.signal(heard, handler)
