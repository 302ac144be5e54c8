"""Names who holds the reactor for too long."""

from __future__ import annotations

import sys
import threading
from collections import Counter
from collections.abc import Callable
from time import perf_counter
from types import FrameType

from twisted.logger import Logger

from up.base_module import BaseModule
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command_executor import CommandExecutor

BUDGET_S = 0.020
BEAT_S = 0.1
_SAID_LIMIT = 50


class ReactorMonitor:
    """A thread that looks at the bus every ``BUDGET_S`` and pings the reactor every ``BEAT_S``.

    A dispatch, or a ping without an answer, that is older than the budget is blamed on the module
    or handler that stands in the reactor thread's stack: logged once each and counted. Nothing
    longer than the budget escapes on the bus: a look that comes early waits for the rest.
    """

    log = Logger()

    def __init__(self, executor: CommandExecutor, call_from_thread: Callable[..., object]) -> None:
        self.culprits: Counter[str] = Counter()
        self._executor = executor
        self._call_from_thread = call_from_thread
        self._reactor_thread = threading.get_ident()
        self._stop = threading.Event()
        self._pinged_s = 0.0
        self._answered = True
        self._blamed_s = 0.0
        self._thread = threading.Thread(target=self._run, name="reactor-monitor", daemon=True)

    def start(self) -> None:
        """Begin to watch the calling thread, which is the reactor's."""
        self._reactor_thread = threading.get_ident()
        self._thread.start()

    def stop(self) -> None:
        """Watch no more."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join(BUDGET_S * 5)

    def _run(self) -> None:
        while not self._stop.wait(BUDGET_S):
            self._look_at_bus()
            self._look_at_reactor()

    def _look_at_bus(self) -> None:
        since_s = self._executor.dispatching_since
        if not since_s:
            return
        rest_s = BUDGET_S - (perf_counter() - since_s)
        if rest_s > 0 and self._stop.wait(rest_s):
            return
        if self._executor.dispatching_since == since_s:
            self._blame(since_s)

    def _look_at_reactor(self) -> None:
        now_s = perf_counter()
        if not self._answered:
            if now_s - self._pinged_s > BUDGET_S:
                self._blame(self._pinged_s)
        elif now_s - self._pinged_s >= BEAT_S:
            self._answered = False
            self._pinged_s = now_s
            self._call_from_thread(self._answer)

    def _answer(self) -> None:
        self._answered = True

    def _blame(self, since_s: float) -> None:
        if since_s == self._blamed_s:
            return
        self._blamed_s = since_s
        frame = sys._current_frames().get(self._reactor_thread)
        culprit = culprit_in(frame)
        self.culprits[culprit] += 1
        if self.culprits[culprit] == 1 and len(self.culprits) <= _SAID_LIMIT:
            self.log.error(
                "{culprit} holds the reactor for more than {ms:.0f} ms, and with it everything"
                " (said once, then counted)",
                culprit=culprit,
                ms=BUDGET_S * 1000,
            )


def culprit_in(frame: FrameType | None) -> str:
    """Return who stands in a stack: the innermost module or handler, else the innermost line."""
    innermost = frame
    while frame is not None:
        owner = frame.f_locals.get("self")
        if isinstance(owner, BaseModule | BaseCommandHandler):
            return type(owner).__name__
        frame = frame.f_back
    if innermost is None:
        return "?"
    return f"{innermost.f_code.co_filename}:{innermost.f_lineno}"
