"""A reactor's poller that has an alarm run while the reactor works, and none while it waits."""

from __future__ import annotations

import signal
from typing import Any


class WatchedPoller:
    """Stands in for the `epoll` or `poll` object of a Twisted reactor.

    SIGALRM is sent to the process when the reactor has not come back to wait within ``budget_s``.
    Two calls of setitimer(2) a round cost 1 us; a thread that looks every 20 ms costs half a per
    cent of a core. ``is_waiting`` tells which of the two it is.
    """

    def __init__(self, poller: Any, budget_s: float) -> None:
        self.poller = poller
        self.is_waiting = False
        self.register = poller.register
        self.modify = poller.modify
        self.unregister = poller.unregister
        self._poll = poller.poll
        self._budget_s = budget_s

    def poll(
        self, *arguments: Any, _set: Any = signal.setitimer, _real: int = signal.ITIMER_REAL
    ) -> Any:
        """Wait as the poller does."""
        _set(_real, 0.0)
        self.is_waiting = True
        try:
            return self._poll(*arguments)
        finally:
            self.is_waiting = False
            _set(_real, self._budget_s)
