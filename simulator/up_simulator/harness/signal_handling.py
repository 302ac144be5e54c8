"""SIGTERM and SIGHUP cause the same orderly end as Ctrl-C."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
SAME_SIGNAL_S = 1.0
STATUS_OFFSET = 128
Handler = Callable[[int, FrameType | None], object]


def handle(number: int, handler: Handler) -> None:
    """Handle a signal, unless it is ignored, as after ``nohup``."""
    if signal.getsignal(number) != signal.SIG_IGN:
        signal.signal(number, handler)


class FirstSignal:
    """The first signal received."""

    def __init__(self) -> None:
        self._number: int | None = None
        self._received_s = 0.0

    def receive(self, number: int, _frame: object) -> None:
        """Raise KeyboardInterrupt.

        Signals within a second count as one: a terminal that closes sends two, from the kernel
        and from the shell, and the second must not disturb the orderly end.
        """
        now_s = time.monotonic()
        if self._number is None:
            self._number = number
        elif now_s - self._received_s < SAME_SIGNAL_S:
            return
        self._received_s = now_s
        raise KeyboardInterrupt

    def status(self, status: int) -> int:
        """Return the exit status: 128 plus the signal, as in a shell, after a signal."""
        return status if self._number is None or status == 0 else STATUS_OFFSET + self._number


@contextmanager
def orderly_exit() -> Iterator[FirstSignal]:
    """Make each of the signals raise KeyboardInterrupt, except ignored ones (``nohup``)."""
    first = FirstSignal()
    before = {number: signal.getsignal(number) for number in SIGNALS}
    for number in SIGNALS:
        handle(number, first.receive)
    try:
        yield first
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


class PendingInterrupt:
    """Whether a signal has requested the end."""

    def __init__(self) -> None:
        self.is_requested = False

    def check(self) -> None:
        """Raise KeyboardInterrupt if so."""
        if self.is_requested:
            raise KeyboardInterrupt


@contextmanager
def interrupts_between_steps() -> Iterator[PendingInterrupt]:
    """Record the signals, to be checked between steps; a second Ctrl-C ends in any place.

    A KeyboardInterrupt from Python could arise inside a call from C, which would swallow it.
    Signals without a handler are left alone.
    """
    interrupt = PendingInterrupt()
    before: dict[int, Handler] = {}

    def record(number: int, frame: FrameType | None) -> None:
        is_second, interrupt.is_requested = interrupt.is_requested, True
        with suppress(KeyboardInterrupt):
            before[number](number, frame)
            return
        if is_second and number == signal.SIGINT:
            raise KeyboardInterrupt

    for each in SIGNALS:
        handler = signal.getsignal(each)
        if callable(handler):
            before[each] = handler
            signal.signal(each, record)
    try:
        yield interrupt
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
