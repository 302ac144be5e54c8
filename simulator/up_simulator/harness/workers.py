"""Flies many trials in a few processes, and reports the progress."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from types import TracebackType
from typing import Any, TypeVar

from up.system.death_signal import request_death_signal
from up_simulator.harness.signal_handling import SIGNALS

T = TypeVar("T")
MAX_PROCESSES = 2


class Workers:
    """A pool of processes for trials, this one included. Use it with ``with``.

    ``on_flown`` gets after each trial the number flown and the number requested so far.
    """

    def __init__(
        self, processes: int = 1, on_flown: Callable[[int, int], None] = lambda _done, _of: None
    ) -> None:
        self._on_flown = on_flown
        self._flown = self._asked = 0
        self._pool: ProcessPoolExecutor | None = None
        if processes > 1:
            # A fresh interpreter: a fork would share the state of JSBSim and simavr.
            context = multiprocessing.get_context("spawn")
            self._pool = ProcessPoolExecutor(processes, context, _begin_worker, (os.getpid(),))

    def __enter__(self) -> Workers:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """End the processes; after an error or an interrupt, in mid-flight."""
        if self._pool is not None:
            if kind is not None:
                for process in multiprocessing.active_children():
                    process.kill()
            self._pool.shutdown(cancel_futures=kind is not None)

    def fly(self, trial: Callable[..., T], arguments: Sequence[tuple[Any, ...]]) -> list[T]:
        """Return the results of ``trial`` for each of the arguments, in their order."""
        found = dict(self.flown(trial, arguments))
        return [found[at] for at in range(len(arguments))]

    def flown(
        self, trial: Callable[..., T], arguments: Sequence[tuple[Any, ...]]
    ) -> Iterator[tuple[int, T]]:
        """Yield each result as soon as it is there, with the number of its arguments."""
        self._asked += len(arguments)
        if self._pool is None:
            for at, each in enumerate(arguments):
                result = trial(*each)
                self._count()
                yield at, result
            return
        # Starts the processes: whole, and with the signals blocked until each has its handlers.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
        try:
            futures = {self._pool.submit(trial, *each): at for at, each in enumerate(arguments)}
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        for future in as_completed(futures):
            result = future.result()
            self._count()
            yield futures[future], result

    def _count(self) -> None:
        self._flown += 1
        self._on_flown(self._flown, self._asked)


def _begin_worker(parent: int) -> None:
    """Leave Ctrl-C and a closed terminal to the parent, and end with it."""
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)
    wish = request_death_signal(signal.SIGKILL, parent)
    if wish is not None:
        wish()
