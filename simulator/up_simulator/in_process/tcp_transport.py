"""A Twisted transport over a simulated connection."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from twisted.internet.address import IPv4Address
from twisted.internet.error import ConnectionAborted, ConnectionDone
from twisted.internet.interfaces import ITransport
from twisted.logger import Logger
from twisted.python.failure import Failure
from zope.interface import implementer

from up_simulator.in_process.network import ADDRESS
from up_simulator.in_process.tcp_end import SocketOptions, TcpEnd

BUFFER_LIMIT = 65536
"""Above this a streaming producer is paused, as in Twisted's own transports."""


@implementer(ITransport)
class TcpTransport:
    """Writes as a reactor does: queued data leaves at the end of the step, then more is requested.

    A protocol that raises loses its connection, and the failure is logged.
    """

    log = Logger()

    def __init__(self, host: Any, end: TcpEnd, own_port: int, peer_port: int) -> None:
        self.protocol: Any = None
        self.on_closed: Callable[[Failure], object] | None = None
        self.connected = False
        self.disconnected = False
        self.disconnecting = False
        self._host = host
        self._end = end
        self._address = IPv4Address("TCP", ADDRESS, own_port)
        self._peer = IPv4Address("TCP", ADDRESS, peer_port)
        self._waiting = bytearray()
        self._producer: Any = None
        self._is_streaming = False
        self._is_paused = False
        end.owner = self
        host.opened[self] = None

    # Called by programs.

    def write(self, data: bytes) -> None:
        if not isinstance(data, bytes | bytearray | memoryview):
            raise TypeError(f"bytes can be written, not {type(data).__name__}")
        if self.disconnected or not data:
            return
        self._waiting += data
        if self._is_streaming and not self._is_paused and len(self._waiting) > BUFFER_LIMIT:
            self._is_paused = True
            self._producer.pauseProducing()
        self._want_to_write()

    def writeSequence(self, iovec: Iterable[bytes]) -> None:  # noqa: N802 - Twisted's name
        self.write(b"".join(iovec))

    def loseConnection(self) -> None:  # noqa: N802 - Twisted's name
        """Send the queued data, then close."""
        if self.connected and not self.disconnecting:
            self.disconnecting = True
            self._want_to_write()

    def abortConnection(self) -> None:  # noqa: N802 - Twisted's name
        """Abort the connection; the other side gets a reset."""
        if not self.disconnected and self._end.owner is self:
            self._end.reset()
            self._host.callLater(0, self._lost, ConnectionAborted())

    def getPeer(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        return self._peer

    def getHost(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        return self._address

    def getHandle(self) -> SocketOptions:  # noqa: N802 - Twisted's name
        return self._end.options

    def setTcpNoDelay(self, enabled: bool) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: no data is delayed here."""

    def setTcpKeepAlive(self, enabled: bool) -> None:  # noqa: N802 - Twisted's name
        """Probe a silent peer."""
        self._end.options.keeps_alive = bool(enabled)
        # Its intervals are set in the calls that follow this one.
        self._host.callLater(0, self._end.watch)

    def registerProducer(self, producer: Any, streaming: bool) -> None:  # noqa: N802
        """Resume a producer when the queue is empty, or pause it when the queue is long."""
        if self._producer is not None:
            raise RuntimeError(f"a producer is already registered: {self._producer!r}")
        if self.disconnected:
            producer.stopProducing()
            return
        self._producer, self._is_streaming = producer, streaming
        if not streaming:
            producer.resumeProducing()

    def unregisterProducer(self) -> None:  # noqa: N802 - Twisted's name
        self._producer = None
        self._is_streaming = self._is_paused = False
        if self.connected and self.disconnecting:
            self._want_to_write()

    # Called by the network and the host.

    def flush(self) -> None:
        """Send as much as the connection takes, and resume the producer."""
        if self._host.is_frozen:
            self._host.do(self._want_to_write)
            return
        if self.disconnected or not self.connected:
            return
        room = self._end.room
        if self._waiting and room:
            part = bytes(self._waiting[:room])
            del self._waiting[:room]
            self._end.write(part)
        if self._waiting:
            return
        if self._producer is not None and (not self._is_streaming or self._is_paused):
            self._is_paused = False
            self._guarded(self._producer.resumeProducing)
        elif self.disconnecting and self._producer is None:
            self._end.close()
            self._lost(ConnectionDone())

    def cut_off(self) -> None:
        """End as the connection of a killed process: its system closes it."""
        self.connected, self.disconnected = False, True
        self._waiting.clear()
        if not self._end.is_closed:
            self._end.close()

    def refuse(self) -> None:
        self.disconnected = True
        self._host.opened.pop(self, None)
        self._end.reset()

    def on_established(self) -> None:
        self._host.do(self._made)

    def on_bytes(self, data: bytes) -> None:
        self._host.do(self._received, data)

    def on_eof(self) -> None:
        """Notify the protocol of the other side's half-close."""
        self._host.do(self._ended)

    def on_lost(self, error: Exception) -> None:
        """Notify the protocol of the lost connection."""
        self._host.do(self._lost, error)

    def on_room(self) -> None:
        if self._waiting or self.disconnecting or self._producer is not None:
            self._want_to_write()

    def _made(self) -> None:
        if self.protocol is not None:
            self.connected = True
            self._guarded(self.protocol.makeConnection, self)

    def _received(self, data: bytes) -> None:
        if self.connected and not self.disconnecting:
            self._guarded(self.protocol.dataReceived, data)

    def _ended(self) -> None:
        if not self.disconnected:
            self._end.close()
            self._lost(ConnectionDone())

    def _want_to_write(self) -> None:
        self._host.network.to_write[self] = None

    def _lost(self, error: Exception) -> None:
        if self.disconnected:
            return
        was_connected = self.connected
        self.connected, self.disconnected = False, True
        self._waiting.clear()
        self._host.opened.pop(self, None)
        producer, self._producer = self._producer, None
        if producer is not None:
            self._guarded(producer.stopProducing)
        reason = Failure(error)
        if was_connected:
            self._guarded(self.protocol.connectionLost, reason)
        if self.on_closed is not None:
            self._guarded(self.on_closed, reason)

    def _guarded(self, call: Any, *arguments: Any) -> None:
        try:
            call(*arguments)
        except Exception as error:  # noqa: BLE001 - as of any reactor: it costs the connection
            self.log.failure("an unhandled error in {name}", name=type(self.protocol).__name__)
            if not self.disconnected:
                self._end.reset()
                self._lost(error)
