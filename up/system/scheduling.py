"""The process: real-time priority, garbage collection while idle, wake-up on signals, forced end.

A full collection of a program of this size takes tens of milliseconds. Objects that exist after the
start are frozen, the automatic collector is off, and young garbage is collected once a second
between two turns of the reactor; bus and codecs create no cycles, so there is little of it.
"""

from __future__ import annotations

import gc
import os
import queue
import signal
import socket
import threading
from collections.abc import Callable
from typing import Any

from twisted.internet.interfaces import IReadDescriptor
from twisted.logger import Logger
from zope.interface import implementer

from up.system.clock import Clock, Timer, cancel

log = Logger()


def use_realtime_priority(priority: int) -> bool:
    """Run this process under SCHED_FIFO with a priority of 1 to 99; 0 changes nothing.

    Returns whether the system permitted it; logs a refusal with the remedy.
    """
    if priority == 0:
        return False
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
    except PermissionError:
        log.warn(
            "real-time priority {priority} is not permitted: run as root, or let systemd do it"
            " (CPUSchedulingPolicy=fifo) or 'ulimit -r'; continuing without it",
            priority=priority,
            code="realtime_denied",
        )
        return False
    except OSError as error:
        log.warn(
            "cannot set real-time priority: {error}; continuing without it",
            error=error,
            code="realtime_failed",
        )
        return False
    log.info("real-time priority {priority} (SCHED_FIFO)", priority=priority, code="realtime_set")
    return True


PERIOD_S = 1.0
FULL_COLLECTION_EVERY = 300


class GcScheduler:
    """Replaces the automatic collector once the program has started."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
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
        gc.collect(1 if self._rounds % FULL_COLLECTION_EVERY else 2)


_AT_ONCE = 4096


@implementer(IReadDescriptor)
class SignalWakeup:
    """Ends the reactor's wait when a signal arrives.

    Python runs a handler only between two instructions: without this, a signal that another thread
    receives, or that arrives just before the wait, would be handled only at the next timer.
    """

    def __init__(self, reactor: Any) -> None:
        self._reactor = reactor
        self._reader, self._writer = socket.socketpair()
        self._reader.setblocking(False)
        self._writer.setblocking(False)

    def start(self) -> None:
        signal.set_wakeup_fd(self._writer.fileno(), warn_on_full_buffer=False)
        self._reactor.addReader(self)

    def fileno(self) -> int:
        return self._reader.fileno()

    def doRead(self) -> None:  # noqa: N802 - Twisted's name
        self._reader.recv(_AT_ONCE)

    def connectionLost(self, reason: object) -> None:  # noqa: N802 - Twisted's name
        signal.set_wakeup_fd(-1)
        self._reader.close()
        self._writer.close()

    def logPrefix(self) -> str:  # noqa: N802 - Twisted's name
        return "signals"


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
