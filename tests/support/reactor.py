"""Runs one coroutine on the real reactor, as a program would, and leaves nothing behind."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import Any

from twisted.internet import reactor as _reactor
from twisted.internet.defer import Deferred
from twisted.internet.error import AlreadyCalled, AlreadyCancelled

reactor: Any = _reactor


class StillBusyError(AssertionError):
    """A test left sockets or timers in the reactor."""


def run_in_reactor(
    function: Callable[..., Coroutine[Any, Any, Any]], *args: Any, timeout_s: float = 60.0
) -> Any:
    """Run ``function(*args)`` to its end on the real reactor and return its result.

    The reactor is crashed afterwards, not stopped, so that the next test may run it again (as
    trial does). Readers, writers and delayed calls that the test left are an error.
    """
    outcome: list[Any] = []
    before = set(reactor.getReaders()) | set(reactor.getWriters())

    def finish(result: Any) -> None:
        outcome.append(result)
        reactor.crash()

    task: list[Deferred[Any]] = []

    def start() -> None:
        task.append(Deferred.fromCoroutine(function(*args)))
        task[0].addBoth(finish)

    limit = reactor.callLater(timeout_s, lambda: task[0].cancel())
    reactor.callWhenRunning(start)
    reactor.run(installSignalHandlers=False)
    try:
        limit.cancel()
    except (AlreadyCalled, AlreadyCancelled):
        raise TimeoutError(f"not finished after {timeout_s} s") from None
    result = outcome[0]
    if hasattr(result, "raiseException"):
        _clean()
        result.raiseException()
    _check_clean(before)
    return result


def sleep(seconds: float) -> Deferred[None]:
    """Return a Deferred that fires after some time: for polling a condition, not for luck."""
    done: Deferred[None] = Deferred()
    reactor.callLater(seconds, done.callback, None)
    return done


async def until(condition: Callable[[], Any], timeout_s: float = 30.0, what: str = "") -> Any:
    """Wait until ``condition()`` is true and return its value; fail after ``timeout_s``."""
    deadline = reactor.seconds() + timeout_s
    while not (value := condition()):
        if reactor.seconds() > deadline:
            raise AssertionError(f"not within {timeout_s} s: {what or condition}")
        await sleep(0.005)
    return value


def _clean() -> None:
    for call in reactor.getDelayedCalls():
        call.cancel()
    waker = getattr(reactor, "waker", None)
    for selectable in reactor.removeAll():
        if selectable is not waker and hasattr(selectable, "connectionLost"):
            from twisted.internet.main import CONNECTION_LOST
            from twisted.python.failure import Failure

            selectable.connectionLost(Failure(CONNECTION_LOST))


def _check_clean(before: set[Any]) -> None:
    for _ in range(20):
        reactor.iterate(0)
    calls = [str(call) for call in reactor.getDelayedCalls()]
    left = (set(reactor.getReaders()) | set(reactor.getWriters())) - before
    left = {
        each
        for each in left
        if type(each).__name__ not in ("_Waker", "_UnixWaker", "_SIGCHLDWaker")
    }
    if calls or left:
        _clean()
        raise StillBusyError(f"left in the reactor: {calls} {left}")
