"""A reactor's poller with an alarm that runs only while the reactor works."""

from __future__ import annotations

import signal
from typing import Any


class WatchedPoller:
    """Replaces the `epoll` or `poll` object of a Twisted reactor.

    The process receives SIGALRM when the reactor does not return to its wait within ``budget_s``.
    Two calls of setitimer(2) per round cost 1 us; a thread that polls every 20 ms costs half a per
    cent of a core. ``is_waiting`` is true during the wait.
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
        """Wait like the wrapped poller."""
        _set(_real, 0.0)
        self.is_waiting = True
        try:
            return self._poll(*arguments)
        finally:
            self.is_waiting = False
            _set(_real, self._budget_s)
