"""Puts Twisted's connections into the poller, so that they wait no longer than a relayed line."""

import select
from collections.abc import Callable
from typing import Any

from twisted.internet.main import CONNECTION_DONE, CONNECTION_LOST
from twisted.internet.tcp import Connector
from twisted.python.failure import Failure
from zope.interface import directlyProvides, providedBy

from up_proxy.poller import READ, WRITE, Poller

_BROKEN = select.EPOLLHUP | select.EPOLLERR
_READ_BYTES = 65536
_GATHERED_BYTES = 16384
"""A larger write does not wait for others: a slow peer must be noticed before more is written."""


class PollerReactor:
    """The reactor, except that the poller waits for its connections.

    The poller works for up to 20 ms before the reactor looks at its own sockets. Data are sent
    when they are written, or after at most 31 other events, not in the next round.
    """

    def __init__(self, reactor: Any, poller: Poller) -> None:
        self._reactor = reactor
        self._poller = poller
        self._handlers: dict[Any, _Descriptor] = {}
        directlyProvides(self, providedBy(reactor))

    def __getattr__(self, name: str) -> Any:
        return getattr(self._reactor, name)

    def connectTCP(  # noqa: N802 - Twisted's name
        self, host: str, port: int, factory: Any, timeout: float = 30, *more: Any, **named: Any
    ) -> Any:
        """Connect as the reactor does."""
        make: Any = Connector
        source = more[0] if more else named.get("bindAddress")
        connector = make(host, port, factory, timeout, source, self)
        connector.connect()
        return connector

    def addReader(self, descriptor: Any) -> None:  # noqa: N802 - Twisted's name
        self._change(descriptor, READ, 0)

    def removeReader(self, descriptor: Any) -> None:  # noqa: N802 - Twisted's name
        self._change(descriptor, 0, READ)

    def addWriter(self, descriptor: Any) -> None:  # noqa: N802 - Twisted's name
        """Write now, and wait only for the rest; a closing connection, not read, just waits."""
        handler = self._handlers.get(descriptor)
        if handler is None or handler.events & WRITE or not handler.events & READ:
            self._change(descriptor, WRITE, 0)
        else:
            # The poller need not know of an immediate write.
            handler.is_writing = True
            handler.events |= WRITE
            handler.write()
            handler.is_writing = False
            self._watch(handler)

    def attach(self, transport: Any, on_data: Callable[[bytes], object]) -> Callable[[bytes], None]:
        """Hand what a transport receives to `on_data`, and return what writes to it.

        Both without Twisted's buffers while nothing waits in them. What several events write of
        one moment leaves together.
        """
        handler = self._handlers.get(transport)
        if handler is None:  # TLS
            return _Gathering(self._poller, transport.write).send
        handler.on_data = on_data
        return _Gathering(self._poller, handler.send).send

    def removeWriter(self, descriptor: Any) -> None:  # noqa: N802 - Twisted's name
        self._change(descriptor, 0, WRITE)

    def _change(self, descriptor: Any, add: int, remove: int) -> None:
        handler = self._handlers.get(descriptor)
        if handler is None:
            if add:
                handler = self._handlers[descriptor] = _Descriptor(self._reactor, descriptor)
                handler.events = handler.watched = add
                self._poller.watch(handler.fileno, handler, add)
            return
        handler.events = (handler.events | add) & ~remove
        if not handler.is_writing:
            self._watch(handler)

    def _watch(self, handler: "_Descriptor") -> None:
        if not handler.events:
            if self._handlers.pop(handler.descriptor, None) is not None:
                self._poller.discard(handler.fileno)
        elif handler.events != handler.watched:
            handler.watched = handler.events
            self._poller.change(handler.fileno, handler.events)


class _Gathering:
    """Joins what several events of one moment write: one call of the system for all of it.

    The order of the writes is kept.
    """

    def __init__(self, poller: Poller, write: Callable[[bytes], None]) -> None:
        self._poller = poller
        self._write = write
        self._waiting: list[bytes] = []

    def send(self, data: bytes) -> None:
        """Write now, or a moment later if there are several events."""
        if not self._poller.gathers or len(data) > _GATHERED_BYTES:
            if self._waiting:
                self._flush()
            self._write(data)
            return
        if not self._waiting:
            self._poller.flush_later(self._flush)
        self._waiting.append(data)

    def _flush(self) -> None:
        waiting, self._waiting = self._waiting, []
        if waiting:
            self._write(b"".join(waiting))


class _Descriptor:
    """A descriptor of Twisted as a handler of the poller."""

    def __init__(self, reactor: Any, descriptor: Any) -> None:
        self._reactor = reactor
        self.descriptor = descriptor
        self.fileno: int = descriptor.fileno()
        self.events = self.watched = 0
        self.is_writing = False
        self.on_data: Callable[[bytes], object] | None = None

    def on_ready(self, events: int) -> None:
        # The path of every relayed line: avoid every unnecessary call.
        if events == select.EPOLLIN and self.on_data is not None and self.events & READ:
            try:
                data = self.descriptor.socket.recv(_READ_BYTES)
            except (BlockingIOError, InterruptedError):
                pass
            except OSError:
                self.lose(CONNECTION_LOST)
            else:
                if data:
                    self.on_data(data)
                else:
                    self.lose(CONNECTION_DONE)
            return
        why = None
        if events & (READ | _BROKEN) and self.events & READ:
            why = self.descriptor.doRead()
        if why is None and events & (WRITE | _BROKEN) and self.events & WRITE:
            why = self.descriptor.doWrite()
        if why is not None:
            self.lose(why)

    def send(self, data: bytes) -> None:
        if self.events != READ:
            if self.events:  # without any it is closed
                self.descriptor.write(data)
            return
        try:
            sent = self.descriptor.socket.send(data)
        except (BlockingIOError, InterruptedError):
            sent = 0
        except OSError:
            self._reactor.callLater(0, self.lose, CONNECTION_LOST)
            return
        if sent < len(data):
            self.descriptor.write(data[sent:])

    def write(self) -> None:
        why = self.descriptor.doWrite()
        if why is not None:
            # The writer may be busy.
            self._reactor.callLater(0, self.lose, why)

    def fail(self, reason: str) -> None:
        """Close the connection on which the proxy failed."""
        self.descriptor.abortConnection()

    def end(self) -> None:
        """Do nothing: `fail` requests no end."""

    def lose(self, why: Any) -> None:
        if not self.descriptor.disconnected:
            self.descriptor.connectionLost(Failure(why))
