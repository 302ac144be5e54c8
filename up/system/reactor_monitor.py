"""Reports the module or handler that blocks the event loop for too long."""

import signal
import sys
import threading
from collections import Counter
from types import FrameType
from typing import Any

from twisted.logger import Logger, LogLevel

BUDGET_S = 0.020
"""The time budget of a call that has no longer one."""

OTHERS = "others"
_NAMED_LIMIT = 50
JOIN_S = 1.0
_NOT_TO_BLAME = frozenset({*sys.stdlib_module_names, "twisted", "zope"})


class ReactorMonitor:
    """A thread that an alarm wakes when the reactor has not waited for ``BUDGET_S``.

    The block is attributed to the innermost instance of ``owners`` in the reactor thread's stack:
    logged once for each, counted once per block. It detects every block longer than the budget
    (the owner's ``TIME_BUDGET_S``, if it is longer than BUDGET_S), whether in a dispatch of the
    bus, a timer or a connection's data. While nothing blocks, the thread sleeps. A reactor without
    `epoll` or `poll` is not monitored.

    Until ``has_started`` a block is normal (modules open files, garbage is collected): it is logged
    as information and not counted.
    """

    log = Logger()

    def __init__(self, reactor: Any, owners: tuple[type, ...]) -> None:
        self.blocking_calls: Counter[str] = Counter()
        self._owners = owners
        self.has_started = False
        self._at_start: Counter[str] = Counter()
        self._reactor = reactor
        self._reactor_thread = threading.get_ident()
        self._poller: WatchedPoller | None = None
        self._is_stopped = False
        self._thread = threading.Thread(target=self._run, name="reactor-monitor", daemon=True)

    def start(self) -> None:
        """Start monitoring the calling thread, which is the reactor's and the main one.

        Call it before other threads start: they must not receive the alarm either.
        """
        if not hasattr(self._reactor, "_poller"):
            return
        self._reactor_thread = threading.get_ident()
        # A thread that does not block the signal would be killed by it, and the process with it.
        signal.signal(signal.SIGALRM, _ignore)
        signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGALRM,))
        self._poller = WatchedPoller(self._reactor._poller, BUDGET_S)
        self._reactor._poller = self._poller
        signal.setitimer(signal.ITIMER_REAL, BUDGET_S)
        self._thread.start()

    def stop(self) -> None:
        if self._poller is None:
            return
        self._reactor._poller, self._poller = self._poller.poller, None
        self._is_stopped = True
        # Wakes the thread if nothing else does.
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.pthread_kill(self._thread.ident or 0, signal.SIGALRM)
        self._thread.join(JOIN_S)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, (signal.SIGALRM,))

    def _run(self) -> None:
        is_alarmed = False
        while True:
            if not is_alarmed:
                signal.sigwait((signal.SIGALRM,))
            is_alarmed = False
            frame = self._frame()
            poller = self._poller
            if self._is_stopped or poller is None:
                return
            turn = poller.turn
            if poller.is_waiting:
                continue
            call, budget_s = blocking_call_in(frame, self._owners)
            if budget_s > BUDGET_S:
                rest_s = budget_s - BUDGET_S
                is_alarmed = signal.sigtimedwait((signal.SIGALRM,), rest_s) is not None
                if is_alarmed or poller.is_waiting or poller.turn != turn:
                    continue
            self._count_block(call, budget_s)

    def _frame(self) -> FrameType | None:
        return sys._current_frames().get(self._reactor_thread)

    def _count_block(self, name: str, budget_s: float) -> None:
        counts = self.blocking_calls if self.has_started else self._at_start
        if name not in counts and len(counts) >= _NAMED_LIMIT:
            name = OTHERS
        counts[name] += 1
        if counts[name] == 1:
            self.log.emit(
                LogLevel.error if self.has_started else LogLevel.info,
                "{call} blocks the event loop for more than {ms:.0f} ms{when} (logged once)",
                call=name,
                ms=budget_s * 1000,
                when="" if self.has_started else " during start-up",
                code="event_loop_blocked",
            )


def blocking_call_in(frame: FrameType | None, owners: tuple[type, ...]) -> tuple[str, float]:
    """Return the class of the innermost owner in a stack, and its budget in seconds.

    Without an owner: the name of a function, and the default.
    """
    innermost = frame
    while frame is not None:
        owner = frame.f_locals.get("self")
        if isinstance(owner, owners):
            return type(owner).__name__, getattr(owner, "TIME_BUDGET_S", BUDGET_S)
        frame = frame.f_back
    return _function_in(innermost), BUDGET_S


def _function_in(innermost: FrameType | None) -> str:
    frame = innermost
    while frame is not None:
        name = frame.f_globals.get("__name__", "?")
        if name.partition(".")[0] not in _NOT_TO_BLAME:
            return f"{name}.{frame.f_code.co_qualname}"
        frame = frame.f_back
    if innermost is None:
        return "?"
    return f"{innermost.f_globals.get('__name__', '?')}.{innermost.f_code.co_qualname}"


def _ignore(number: int, frame: FrameType | None) -> None:
    """Consume an alarm that arrived while no thread waited for it."""


class WatchedPoller:
    """Replaces the `epoll` or `poll` object of a Twisted reactor.

    The process receives SIGALRM when the reactor does not return to its wait within ``budget_s``.
    Two calls of setitimer(2) per round cost 1 us; a thread that polls every 20 ms costs half a per
    cent of a core. ``is_waiting`` is true during the wait.
    """

    def __init__(self, poller: Any, budget_s: float) -> None:
        self.poller = poller
        self.is_waiting = False
        self.turn = 0
        self.register = poller.register
        self.modify = poller.modify
        self.unregister = poller.unregister
        self._poll = poller.poll
        self._budget_s = budget_s

    def poll(
        self, *arguments: Any, _set: Any = signal.setitimer, _real: int = signal.ITIMER_REAL
    ) -> Any:
        _set(_real, 0.0)
        self.turn += 1
        self.is_waiting = True
        try:
            return self._poll(*arguments)
        finally:
            self.is_waiting = False
            _set(_real, self._budget_s)
