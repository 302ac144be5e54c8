"""Runs Python's garbage collector only while the program is idle, and not during a start.

A full collection of a program of this size takes tens of milliseconds. Objects that exist after the
start are frozen, the automatic collector is off, and young garbage is collected once a second
between two turns of the reactor; bus and codecs create no cycles, so there is little of it.
"""

import gc
from collections.abc import Iterator
from contextlib import contextmanager

from up.system.clock import Clock, Timer, cancel

PERIOD_S = 1.0
FULL_PERIOD_S = 300.0


@contextmanager
def frozen_imports() -> Iterator[None]:
    """Turn the collector off while modules are imported, and freeze them.

    It finds no garbage in them, and takes a tenth of a start.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


class GcScheduler:
    """Replaces the automatic collector once the program has started.

    `full_period_s`: time between two collections of all objects that are not frozen.
    """

    def __init__(self, clock: Clock, full_period_s: float = FULL_PERIOD_S) -> None:
        self._clock = clock
        self._full_every = round(full_period_s / PERIOD_S)
        self._rounds = 0
        self._call: Timer | None = None

    def start(self) -> None:
        """Freeze the existing objects and replace the automatic collector."""
        gc.collect()
        gc.freeze()
        gc.disable()
        self._schedule()

    def stop(self) -> None:
        cancel(self._call)
        gc.enable()
        gc.unfreeze()

    def _schedule(self) -> None:
        self._call = self._clock.callLater(PERIOD_S, self._collect)

    def _collect(self) -> None:
        self._schedule()
        self._rounds += 1
        gc.collect(1 if self._rounds % self._full_every else 2)
