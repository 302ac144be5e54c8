"""Ends a process that does not end normally."""

import os
import queue
import threading
from collections.abc import Callable


class ExitWatchdog:
    """A thread that, on request, ends the process after ``after_s`` seconds unless cancelled.

    It runs outside the reactor, so it works while the event loop is blocked. Signal handlers may
    call ``request``: it takes no lock that the interrupted code may hold.
    """

    def __init__(self, after_s: float, end: Callable[[int], object] = os._exit) -> None:
        self._after_s = after_s
        self._end = end
        self._requests: queue.SimpleQueue[int] = queue.SimpleQueue()
        self._cancelled = threading.Event()
        self._thread = threading.Thread(target=self._run, name="exit-watchdog", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def request(self, status: int) -> None:
        """End the process with this exit status after the delay; the first request counts."""
        self._requests.put(status)

    def cancel(self) -> None:
        self._cancelled.set()

    def _run(self) -> None:
        status = self._requests.get()
        if not self._cancelled.wait(self._after_s):
            self._end(status)
