"""Ends a process that does not end normally."""

from __future__ import annotations

import os
import queue
import threading
from collections.abc import Callable


class ForcedEnd:
    """A thread that, on request, ends the process after ``after_s`` seconds unless cancelled.

    It runs outside the reactor, so it works while the event loop is blocked. ``ask`` may be called
    from a signal handler: it takes no lock that the interrupted code may hold.
    """

    def __init__(self, after_s: float, end: Callable[[int], object] = os._exit) -> None:
        self._after_s = after_s
        self._end = end
        self._asked: queue.SimpleQueue[int] = queue.SimpleQueue()
        self._called_off = threading.Event()
        self._thread = threading.Thread(target=self._run, name="forced-end", daemon=True)

    def start(self) -> None:
        """Start waiting for a request."""
        self._thread.start()

    def ask(self, status: int) -> None:
        """End the process with this exit status after the delay; the first request counts."""
        self._asked.put(status)

    def call_off(self) -> None:
        """Cancel the end of the process."""
        self._called_off.set()

    def _run(self) -> None:
        status = self._asked.get()
        if not self._called_off.wait(self._after_s):
            self._end(status)
