"""Work with the disk beside the reactor: an SD card may take a second."""

import threading
from _thread import start_new_thread
from collections import deque
from collections.abc import Callable
from typing import Any, TypeVar

from twisted.internet.defer import Deferred
from twisted.python.failure import Failure

_T = TypeVar("_T")
_Piece = tuple[Callable[[], Any], Deferred[Any], threading.Event]


class DiskThread:
    """Runs each piece of work on a daemon thread, one at a time and in their order.

    A disk that hangs does not prevent the program from ending. The results fire on the reactor's
    thread. A reactor with simulated time has ``start_thread``, which does the work immediately.
    """

    def __init__(self, reactor: Any) -> None:
        self._reactor = reactor
        # Thread.start would wait for the thread; a step of a flight mode must not.
        self._start = getattr(reactor, "start_thread", lambda work: start_new_thread(work, ()))
        self._lock = threading.Lock()
        self._waiting: deque[_Piece] = deque()
        self._is_running = False
        self._newest: threading.Event | None = None

    def run(self, work: Callable[[], _T]) -> Deferred[_T]:
        """Return the result of ``work``, which is called as soon as the earlier one is done."""
        done: Deferred[_T] = Deferred()
        self._newest = finished = threading.Event()
        with self._lock:
            self._waiting.append((work, done, finished))
            is_first, self._is_running = not self._is_running, True
        if is_first:
            self._start(self._run)
        return done

    def wait(self) -> None:
        if self._newest is not None:
            self._newest.wait()

    def _run(self) -> None:
        while True:
            with self._lock:
                if not self._waiting:
                    self._is_running = False
                    return
                work, done, finished = self._waiting.popleft()
            try:
                result = work()
            except Exception:  # noqa: BLE001 - the reactor's thread gets it
                self._reactor.callFromThread(done.errback, Failure())
            else:
                self._reactor.callFromThread(done.callback, result)
            finally:
                finished.set()
