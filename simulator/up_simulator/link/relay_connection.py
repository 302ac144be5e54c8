"""One connection through a relay: two sockets, and a link between them."""

from __future__ import annotations

import socket
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from twisted.internet.error import ConnectionDone
from twisted.internet.interfaces import IHalfCloseableProtocol, IPushProducer
from twisted.internet.protocol import ClientFactory, Protocol, connectionDone
from twisted.python.failure import Failure
from zope.interface import implementer

from up_simulator.link.model import LinkModel
from up_simulator.link.stream import LinkStream, Signal

if TYPE_CHECKING:
    from up_simulator.link.relay import LinkRelay

WINDOW = 16 * 1024
"""Bytes on their way at most, each way of each connection; more is not read from its sender."""
SYSTEM_BUFFER = 32 * 1024
"""The system's buffer for a socket of the relay, small enough not to act as part of the link."""


@implementer(IHalfCloseableProtocol, IPushProducer)
class _End(Protocol):
    """One end of a connection: the client's or the target's."""

    outgoing: LinkStream
    incoming: LinkStream

    def __init__(self, connection: RelayedConnection) -> None:
        self._connection = connection
        self._has_finished = False
        self._is_paused = False
        self.is_open = False
        self.is_gone = False

    @property
    def is_connected(self) -> bool:
        return self.transport is not None and not self.is_gone

    def connectionMade(self) -> None:  # noqa: N802
        transport: Any = self.transport
        transport.setTcpNoDelay(True)
        for option in (socket.SO_RCVBUF, socket.SO_SNDBUF):
            transport.getHandle().setsockopt(socket.SOL_SOCKET, option, SYSTEM_BUFFER)
        transport.registerProducer(self, True)
        self._connection.on_made(self)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802
        self.outgoing.send(data)
        self.update_window()

    def update_window(self) -> None:
        """Resume or pause reading by the bytes in flight; no reading before it is open."""
        if not self.is_connected or self._has_finished:
            return
        transport: Any = self.transport
        waiting = self.outgoing.waiting
        if self._is_paused and self.is_open and waiting <= WINDOW // 2:
            self._is_paused = False
            transport.resumeProducing()
        elif not self._is_paused and (waiting >= WINDOW or not self.is_open):
            self._is_paused = True
            transport.pauseProducing()

    def receive(self, content: bytes | Signal) -> None:
        transport: Any = self.transport
        if not self.is_connected:
            return
        if content is Signal.FINISHED:
            transport.loseWriteConnection()
            self._connection.on_finished()
        elif content is Signal.RESET:
            transport.abortConnection()
        elif isinstance(content, bytes):
            transport.write(content)

    def close(self) -> None:
        if self.is_connected:
            transport: Any = self.transport
            transport.unregisterProducer()
            transport.loseConnection()

    def abort(self) -> None:
        if self.is_connected:
            transport: Any = self.transport
            transport.abortConnection()

    def readConnectionLost(self) -> None:  # noqa: N802
        self._has_finished = True
        self.outgoing.send(Signal.FINISHED)

    def writeConnectionLost(self) -> None:  # noqa: N802
        pass

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        self.is_gone = True
        self.incoming.stop()
        if not reason.check(ConnectionDone):
            self.outgoing.send(Signal.RESET)
        self._connection.on_gone()

    def pauseProducing(self) -> None:  # noqa: N802
        self.incoming.is_blocked = True

    def resumeProducing(self) -> None:  # noqa: N802
        self.incoming.is_blocked = False

    def stopProducing(self) -> None:  # noqa: N802
        pass


class _TargetFactory(ClientFactory):
    noisy = False

    def __init__(self, end: _End, on_failed: Callable[[], object]) -> None:
        self._end = end
        self._on_failed = on_failed

    def buildProtocol(self, _address: Any) -> Protocol:  # noqa: N802
        return self._end

    def clientConnectionFailed(self, _connector: Any, _reason: Failure) -> None:  # noqa: N802
        self._on_failed()


class RelayedConnection:
    """A client's connection and the relay's own to the target, with a stream each way.

    The target is called when the opening has arrived, the client is read when the answer has.
    """

    def __init__(self, relay: LinkRelay) -> None:
        self._relay = relay
        self._finished = 0
        self._connector: Any = None
        self.near, self.far = _End(self), _End(self)
        self.near.outgoing = self.far.incoming = self._stream(relay.up, self._on_up, self.near)
        self.far.outgoing = self.near.incoming = self._stream(relay.down, self._on_down, self.far)

    def on_made(self, end: _End) -> None:
        if end is self.near:
            end.update_window()
            end.outgoing.send(Signal.OPEN)
        else:
            end.is_open = True
            end.outgoing.send(Signal.OPENED)
            end.incoming.is_blocked = False

    def on_finished(self) -> None:
        self._finished += 1
        if self._finished == 2:
            self.near.close()
            self.far.close()

    def on_gone(self) -> None:
        """One end has lost its socket, or will never have one."""
        if self.near.is_gone and self.far.is_gone:
            self.near.outgoing.stop()
            self.far.outgoing.stop()
            self._relay.discard(self)

    def abort(self) -> None:
        self.near.outgoing.stop()
        self.far.outgoing.stop()
        self._cancel_far()
        self.near.abort()
        self.far.abort()

    def _stream(
        self, model: LinkModel, deliver: Callable[[bytes | Signal], object], sender: _End
    ) -> LinkStream:
        return LinkStream(
            self._relay.clock,
            model,
            deliver,
            user_timeout_s=self._relay.user_timeout_s,
            on_silence=sender.abort,
        )

    def _on_up(self, content: bytes | Signal) -> None:
        if content is Signal.OPEN:
            # No data arrives at a target that is not connected yet.
            self.near.outgoing.is_blocked = True
            self._connector = self._relay.connect(_TargetFactory(self.far, self._on_refused))
        elif content is Signal.RESET and self.far.transport is None:
            self._cancel_far()
        else:
            self.far.receive(content)
        self.near.update_window()

    def _on_down(self, content: bytes | Signal) -> None:
        if content is Signal.OPENED:
            self.near.is_open = True
            self.near.update_window()
        else:
            self.near.receive(content)
        self.far.update_window()

    def _cancel_far(self) -> None:
        if self.far.transport is not None or self.far.is_gone:
            return
        if self._connector is not None:
            self._connector.stopConnecting()
        else:
            self.far.is_gone = True
            self.on_gone()

    def _on_refused(self) -> None:
        self.far.is_gone = True
        self.near.outgoing.stop()
        self.far.outgoing.send(Signal.RESET)
        self.on_gone()
