"""Waits for many sockets, inside Twisted's reactor.

The reactor has one descriptor, our own epoll: a relayed line then costs no reactor bookkeeping, and
an idle connection no entry in the reactor.
"""

import select
from collections import deque
from collections.abc import Callable
from typing import Any, Protocol

from twisted.internet.interfaces import IReadDescriptor
from zope.interface import implementer

from up.log import UpLogger
from up.system.clock import Timer, cancel

READ = select.EPOLLIN | select.EPOLLRDHUP
WRITE = select.EPOLLOUT
PAUSED = select.EPOLLRDHUP
"""Does not read, but detects a closed peer."""

_BATCH = 256
_GATHERED = 32
"""Events whose writes to one socket leave together; more would keep the first ones too long."""
BUSY_POLL_S = 0.01
"""Longer than a tick of the kernel: a shorter timeout would cost a timer interrupt per line."""
_log = UpLogger.get_logger("proxy")


class Handler(Protocol):
    """A socket that the poller watches."""

    def on_ready(self, events: int) -> None:
        """Handle the epoll events, without blocking."""

    def end(self) -> None:
        """Close the socket and notify its owner; called outside the handling of any event."""

    def fail(self, reason: str) -> None:
        """Request the end, with its reason."""


@implementer(IReadDescriptor)
class Poller:
    """Dispatches socket events; `now_s` is the monotonic time at which the batch began."""

    def __init__(self, reactor: Any, seconds: Callable[[], float]) -> None:
        self._reactor = reactor
        self._seconds = seconds
        self._epoll = select.epoll()
        self._handlers: dict[int, Handler] = {}
        self._ending: list[Handler] = []
        self._steps: deque[Callable[[], None]] = deque()
        self._again: Timer | None = None
        self._flushes: list[Callable[[], None]] = []
        self.gathers = False
        """True while several events are handled."""
        self.busy_poll_s = BUSY_POLL_S
        self.now_s = seconds()

    def start(self) -> None:
        self._reactor.addReader(self)

    def stop(self) -> None:
        """Stop and close the epoll; the owners close their sockets."""
        cancel(self._again)
        self._reactor.removeReader(self)
        self._epoll.close()

    def watch(self, descriptor: int, handler: Handler, events: int = READ) -> None:
        """Call `handler.on_ready` when one of the events occurs."""
        self._handlers[descriptor] = handler
        self._epoll.register(descriptor, events)

    def change(self, descriptor: int, events: int) -> None:
        self._epoll.modify(descriptor, events)

    def discard(self, descriptor: int) -> None:
        """Stop watching a descriptor; call it before closing the descriptor."""
        if self._handlers.pop(descriptor, None) is not None:
            self._epoll.unregister(descriptor)

    def end_later(self, handler: Handler) -> None:
        """End a handler after the current batch.

        Nothing is closed inside a batch: a descriptor's number could be reused within it, and the
        list of receivers must not change during a send.
        """
        self._ending.append(handler)

    def do_later(self, step: Callable[[], None]) -> None:
        """Call a step that takes a millisecond or more: one after each batch of events."""
        self._steps.append(step)
        self._come_back()

    def flush_later(self, flush: Callable[[], None]) -> None:
        """Call `flush` after the current events, 32 at most; for use while `gathers`."""
        self._flushes.append(flush)

    def seconds(self) -> float:
        return self.now_s

    def tick(self) -> float:
        self.now_s = self._seconds()
        return self.now_s

    def reap(self) -> None:
        """End the handlers that requested it; an end may request others."""
        while self._ending:
            self._ending.pop().end()

    def fileno(self) -> int:
        return self._epoll.fileno()

    def logPrefix(self) -> str:  # noqa: N802 - Twisted's name
        return "proxy"

    def connectionLost(self, reason: object) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: the reactor calls it when it stops."""

    def doRead(self) -> None:  # noqa: N802 - Twisted's name
        """Handle the current events, and those that follow closely.

        Under load the next line arrives before the reactor has finished its round: waiting for it
        here saves that round; the reactor's other work waits for at most twice `busy_poll_s`.
        """
        poll = self._epoll.poll
        events = poll(0, _BATCH)
        leave_s = self._seconds() + self.busy_poll_s
        while events or self._steps:
            self._handle(events)
            if self._steps:
                self._call(self._steps.popleft())
            if self.now_s >= leave_s:
                break
            events = poll(0 if self._steps else self.busy_poll_s, _BATCH)
        if self._steps:
            self._come_back()

    def _come_back(self) -> None:
        if self._again is None:
            self._again = self._reactor.callLater(0, self._continue)

    def _continue(self) -> None:
        self._again = None
        self.doRead()

    def _call(self, step: Callable[[], None]) -> None:
        try:
            step()
        except Exception:  # noqa: BLE001 - as in _handle
            _log.failure("a step failed on a bug of the proxy", code="proxy_bug")

    def _handle(self, events: list[tuple[int, int]]) -> None:
        handlers = self._handlers
        self.now_s = self._seconds()
        self.gathers = len(events) > 1
        for at in range(0, len(events), _GATHERED):
            for descriptor, what in events[at : at + _GATHERED]:
                handler = handlers.get(descriptor)
                if handler is None:
                    continue
                try:
                    handler.on_ready(what)
                except Exception:  # noqa: BLE001 - a bug costs one connection, never the relay
                    _log.failure("a connection failed on a bug of the proxy", code="proxy_bug")
                    handler.fail("internal error")
            while self._flushes:
                self._call(self._flushes.pop())
        self.gathers = False
        if self._ending:
            self.reap()
