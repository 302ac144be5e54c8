"""One end of a TCP connection in memory: the program's transport, and its system's TCP below."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from twisted.internet.address import IPv4Address
from twisted.internet.base import DelayedCall
from twisted.internet.error import ConnectionAborted, ConnectionDone, ConnectionLost
from twisted.internet.interfaces import ITransport
from twisted.logger import Logger
from twisted.python.failure import Failure
from zope.interface import implementer

from up.system.clock import cancel
from up_simulator.in_process.network import ADDRESS, Route
from up_simulator.in_process.socket_options import SocketOptions

HEADER = 40
"""Bytes of an IPv4 and a TCP header, which a link carries too."""
SEGMENT = 1448
WINDOW = 10 * SEGMENT
"""Bytes on their way at most (RFC 6928); the rest waits where its program can replace it."""
BUFFER_LIMIT = 65536
"""Above this a streaming producer is paused, as in Twisted's own transports."""
INITIAL_RETRY_S, MIN_RETRY_S, MAX_RETRY_S = 1.0, 0.2, 120.0


@implementer(ITransport)
class TcpConnection:
    """A transport; ``peer`` is the other end, which is only reached through the route.

    Queued data leaves at the end of the step, as of a reactor. Unacknowledged data is sent again.
    A connection ends by a FIN, by a reset, or by silence: TCP_USER_TIMEOUT for unacknowledged
    bytes. Nothing probes an idle one: what flies sends all the time. After its program has closed
    it, or was killed, the system still delivers the sent data. A protocol that raises loses its
    connection, and the failure is logged.
    """

    log = Logger()
    peer: TcpConnection

    def __init__(self, host: Any, route: Route, own_port: int, peer_port: int) -> None:
        self.protocol: Any = None
        self.on_closed: Callable[[Failure], object] | None = None
        self.options = SocketOptions()
        self.connected = self.disconnecting = self.disconnected = False
        self._host = host
        self._clock = host.network.clock
        self._route = route
        self._address = IPv4Address("TCP", ADDRESS, own_port)
        self._peer_address = IPv4Address("TCP", ADDRESS, peer_port)
        self._waiting = bytearray()
        self._producer: Any = None
        self._is_streaming = self._is_paused = False
        # The system's part.
        self._has_program = self._is_established = self._is_finished = self._is_closed = False
        self._sent = self._in_flight = self._expected = 0
        self._unacknowledged: deque[tuple[int, bytes, bool, float]] = deque()
        self._progress_s = self._clock.seconds()
        self._retry_s = INITIAL_RETRY_S
        self._retry: DelayedCall | None = None

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
        if self.connected and not self.disconnecting:
            self.disconnecting = True
            self._want_to_write()

    loseWriteConnection = loseConnection  # noqa: N815 - Twisted's name; the input ends, too

    def abortConnection(self) -> None:  # noqa: N802 - Twisted's name
        """Abort the connection; the other side gets a reset."""
        if not self.disconnected and self._has_program:
            self._reset()
            self._host.callLater(0, self._lost, ConnectionAborted())

    def getPeer(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        return self._peer_address

    def getHost(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        return self._address

    def getHandle(self) -> SocketOptions:  # noqa: N802 - Twisted's name
        return self.options

    def setTcpNoDelay(self, enabled: bool) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: no data is delayed here."""

    def setTcpKeepAlive(self, enabled: bool) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: a silent peer is not probed here."""

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

    # Called by listeners, connectors, the network and the host.

    def attach(self) -> None:
        self._has_program = True
        self._host.opened[self] = None

    def build(self, factory: Any, address: IPv4Address) -> bool:
        """Build the protocol; return False where there is none, which refuses the connection."""
        self.protocol = self._host.reactor.guarded(factory.buildProtocol, address)
        if self.protocol is None:
            self.disconnected = True
            self._host.opened.pop(self, None)
            self._reset()
        return self.protocol is not None

    def establish(self) -> None:
        """Establish the connection: by the handshake, or by bytes that imply it."""
        if not self._is_established and not self._is_closed:
            self._is_established = True
            self._progress_s = self._clock.seconds()
            if self._has_program:
                self._host.do(self._made)

    def flush(self) -> None:
        """Send as much as the connection takes, and resume the producer."""
        if self.disconnected or not self.connected:
            return
        room = WINDOW - self._in_flight if self._is_established and not self._is_closed else 0
        if self._waiting and room:
            part = bytes(self._waiting[:room])
            del self._waiting[:room]
            self.transmit(part)
        if self._waiting:
            return
        if self._producer is not None and (not self._is_streaming or self._is_paused):
            self._is_paused = False
            self._guarded(self._producer.resumeProducing)
        elif self.disconnecting and self._producer is None:
            self._release()
            self._lost(ConnectionDone())

    def transmit(self, data: bytes) -> None:
        for at in range(0, len(data), SEGMENT):
            self._send(data[at : at + SEGMENT], is_last=False)

    def cut_off(self) -> None:
        """End as the connection of a killed process: its system closes it."""
        self.connected, self.disconnected = False, True
        self._waiting.clear()
        if not self._is_closed:
            self._release()

    # Packets from the other end.

    def on_segment(self, offset: int, data: bytes, is_last: bool, sent_s: float) -> None:
        """Take a segment; a duplicate is only acknowledged again."""
        if self._is_closed or (data and not self._has_program):
            self._refuse()
            return
        self.establish()
        if offset > self._expected:
            return
        is_new = offset == self._expected
        if is_new:
            self._expected += len(data) + is_last
        if self._route.pipe is None:
            self.peer.on_acknowledged(self._expected, sent_s)
        else:
            self._route.carry(HEADER, self.peer.on_acknowledged, self._expected, sent_s)
        if is_new and data and self._has_program:
            self._host.do(self._received, data)
        if is_new and is_last and self._has_program:
            self._host.do(self._ended)

    def on_acknowledged(self, offset: int, sent_s: float) -> None:
        if self._is_closed:
            return
        self.establish()
        waiting, before = self._unacknowledged, self._in_flight
        while waiting and waiting[0][0] + len(waiting[0][1]) + waiting[0][2] <= offset:
            self._in_flight -= len(waiting.popleft()[1])
        self._progress_s = self._clock.seconds()
        self._retry_s = max(MIN_RETRY_S, 2 * (self._progress_s - sent_s))
        if not waiting:
            cancel(self._retry)
            self._retry = None
            if self._is_finished and not self._has_program:
                self._end()
                return
        has_more = self._waiting or self.disconnecting or self._producer is not None
        if has_more and self._in_flight < before and self._has_program:
            self._want_to_write()

    def on_reset(self) -> None:
        self._break("the connection was reset")

    # The system's TCP.

    def _send(self, data: bytes, *, is_last: bool) -> None:
        now_s = self._clock.seconds()
        if not self._unacknowledged:
            self._progress_s = now_s
        item = (self._sent, data, is_last, now_s)
        self._sent += len(data) + is_last
        self._in_flight += len(data)
        self._unacknowledged.append(item)
        self._route.carry(HEADER + len(data), self.peer.on_segment, *item)
        if self._retry is None and self._route.pipe is not None:
            self._schedule_retry()

    def _release(self) -> None:
        """Leave the connection to the system: sent data still arrives, then the FIN."""
        self._has_program = False
        if not self._is_finished and not self._is_closed:
            self._is_finished = True
            self._send(b"", is_last=True)

    def _reset(self) -> None:
        if not self._is_closed:
            self._route.carry(HEADER, self.peer.on_reset)
            self._end()

    def _refuse(self) -> None:
        """Answer a packet of a connection that no longer exists."""
        if not self.peer._is_closed:
            self._route.carry(HEADER, self.peer.on_reset)

    def _schedule_retry(self) -> None:
        left_s = self._progress_s + self.options.give_up_s - self._clock.seconds()
        wait_s = max(0.0, min(self._retry_s, left_s))
        self._retry = self._clock.callLater(wait_s, self._send_again)

    def _send_again(self) -> None:
        self._retry = None
        if not self._unacknowledged or self._is_closed:
            return
        now_s = self._clock.seconds()
        if now_s - self._progress_s >= self.options.give_up_s - 1e-6:
            self._break("nothing was acknowledged in time")
            return
        oldest_s = self._unacknowledged[0][3]
        if now_s - max(oldest_s, self._progress_s) >= self._retry_s - 1e-6:
            for offset, data, is_last, _ in self._unacknowledged:
                again = (offset, data, is_last, now_s)
                self._route.carry(HEADER + len(data), self.peer.on_segment, *again)
            self._retry_s = min(2 * self._retry_s, MAX_RETRY_S)
        self._schedule_retry()

    def _break(self, why: str) -> None:
        """Lose the connection without a notice from the other side."""
        if not self._is_closed:
            has_program = self._has_program
            self._end()
            if has_program:
                self._host.do(self._lost, ConnectionLost(why))

    def _end(self) -> None:
        self._is_closed, self._has_program = True, False
        self._unacknowledged.clear()
        self._in_flight = 0
        cancel(self._retry)

    # Calls into the program.

    def _made(self) -> None:
        if self.protocol is not None:
            self.connected = True
            self._guarded(self.protocol.makeConnection, self)

    def _received(self, data: bytes) -> None:
        if self.connected and not self.disconnecting:
            self._guarded(self.protocol.dataReceived, data)

    def _ended(self) -> None:
        if not self.disconnected:
            self._release()
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
                self._reset()
                self._lost(error)
