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
OTHERS = "others"
_NAMED_LIMIT = 50
_WAITING = frozenset({"doPoll", "doSelect"})
_NOT_TO_BLAME = frozenset({*sys.stdlib_module_names, "twisted", "zope"})


class ReactorMonitor:
    """A thread that looks every ``BUDGET_S`` at what the reactor thread does.

    A dispatch of the bus that is older than the budget, or a reactor that is busy and does not
    answer within the budget, is blamed on the module or handler that stands in the reactor
    thread's stack: logged once each, counted once a hold. A look at a dispatch that comes early
    waits for the rest, so none longer than the budget escapes; of the reactor's other work, none
    longer than two budgets. An idle reactor is left alone.
    """

    log = Logger()

    def __init__(self, executor: CommandExecutor, call_from_thread: Callable[..., object]) -> None:
        self.culprits: Counter[str] = Counter()
        self._executor = executor
        self._call_from_thread = call_from_thread
        self._reactor_thread = threading.get_ident()
        self._stop = threading.Event()
        self._is_answered = True
        self._is_hold_blamed = False
        self._pinged_s = 0.0
        self._blamed_dispatch_s = 0.0
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
        if not since_s or since_s == self._blamed_dispatch_s:
            return
        rest_s = BUDGET_S - (perf_counter() - since_s)
        if rest_s > 0 and self._stop.wait(rest_s):
            return
        frame = self._frame()
        if self._executor.dispatching_since == since_s:
            self._blamed_dispatch_s = since_s
            self._blame_hold(frame)

    def _look_at_reactor(self) -> None:
        frame = self._frame()
        if not self._is_answered:
            if perf_counter() - self._pinged_s >= BUDGET_S:
                self._blame_hold(frame)
        elif frame is not None and frame.f_code.co_name not in _WAITING:
            self._is_answered = False
            since_s = self._executor.dispatching_since
            self._is_hold_blamed = bool(since_s) and since_s == self._blamed_dispatch_s
            self._pinged_s = perf_counter()
            self._call_from_thread(self._answer)

    def _answer(self) -> None:
        self._is_answered = True

    def _frame(self) -> FrameType | None:
        return sys._current_frames().get(self._reactor_thread)

    def _blame_hold(self, frame: FrameType | None) -> None:
        if not self._is_answered and self._is_hold_blamed:
            return
        self._is_hold_blamed = True
        culprit = culprit_in(frame)
        if culprit not in self.culprits and len(self.culprits) >= _NAMED_LIMIT:
            culprit = OTHERS
        self.culprits[culprit] += 1
        if self.culprits[culprit] == 1:
            self.log.error(
                "{culprit} holds the reactor for more than {ms:.0f} ms, and with it everything"
                " (said once, then counted)",
                culprit=culprit,
                ms=BUDGET_S * 1000,
            )


def culprit_in(frame: FrameType | None) -> str:
    """Return who stands in a stack: the innermost module or handler, else a function's name."""
    innermost = frame
    while frame is not None:
        owner = frame.f_locals.get("self")
        if isinstance(owner, BaseModule | BaseCommandHandler):
            return type(owner).__name__
        frame = frame.f_back
    return _function_in(innermost)


def _function_in(innermost: FrameType | None) -> str:
    """Return the innermost function that neither Python nor Twisted brings."""
    frame = innermost
    while frame is not None:
        name = frame.f_globals.get("__name__", "?")
        if name.partition(".")[0] not in _NOT_TO_BLAME:
            return f"{name}.{frame.f_code.co_qualname}"
        frame = frame.f_back
    if innermost is None:
        return "?"
    return f"{innermost.f_globals.get('__name__', '?')}.{innermost.f_code.co_qualname}"
