"""One TCP connection of the relay: its socket, its partial line, its send queue."""

import select
import socket
from collections.abc import Callable
from contextlib import suppress

from up.protocols.line_decoder import LineBuffer
from up.system.token_bucket import TokenBucket
from up_proxy.poller import PAUSED, READ, WRITE, Poller
from up_proxy.send_buffer import SendBuffer
from up_proxy.tls_socket import TLSSocket

LINE_MAX_BYTES = 65536
"""A connection that sends a longer line is closed."""
IDLE_S = 15.0
"""A connection without a byte in either direction for this long is closed."""
HIGH_WATER_BYTES = 65536
"""When a paced peer has more than this waiting, its senders are paused."""

_READ_BYTES = 65536
_KEPT_MAX_BYTES = LINE_MAX_BYTES + 4096


class Owner:
    """The owner of a connection, which handles its data."""

    __slots__ = ()

    def on_lines(self, connection: "Connection", lines: bytes) -> None:
        """Handle whole lines; never empty, the last byte is LF."""

    def on_partial_line(self, connection: "Connection") -> None:
        """Check `connection.partial`, a partial line that has grown."""

    def on_drained(self, connection: "Connection") -> None:
        """Handle an empty send buffer."""

    def on_end(self, connection: "Connection", reason: str) -> None:
        """Handle the closed connection; the reason is for people."""


class Connection:
    """Relays whole lines without blocking and with bounded memory.

    With `queue_bytes` a slow peer loses its oldest lines beyond that size; with 0 it loses none,
    and `relay_paced` tells the sender to pause.
    """

    __slots__ = (
        "_closed",
        "_events",
        "_poller",
        "_queue",
        "_socket",
        "_tls",
        "failure",
        "handshakes",
        "host",
        "last_rx_s",
        "last_tx_s",
        "number",
        "owner",
        "partial",
        "paused_s",
        "queue_bytes",
        "reads_attitude",
        "reads_packed",
        "requested_s",
        "speaks_hello",
        "token",
    )

    def __init__(
        self,
        sock: socket.socket | TLSSocket,
        poller: Poller,
        host: str,
        owner: Owner,
        closed: Callable[["Connection"], None],
        queue_bytes: int,
    ) -> None:
        self._socket = sock
        self._tls = sock if isinstance(sock, TLSSocket) else None
        self._closed = closed
        self._poller = poller
        self._queue: SendBuffer | None = None
        self._events = READ
        self.host = host
        self.owner = owner
        self.queue_bytes = queue_bytes
        self.last_rx_s = self.last_tx_s = poller.now_s
        self.requested_s = 0.0
        self.handshakes: TokenBucket | None = None
        self.paused_s: float | None = None
        self.partial: LineBuffer | None = None
        self.failure: str | None = None
        self.number = 0
        self.speaks_hello = False
        self.reads_attitude = False
        self.reads_packed = False
        """It named packed telemetry in its hello; an aircraft: it also knows `Watchers`."""
        self.token = ""
        poller.watch(sock.fileno(), self)

    @property
    def peer_name(self) -> str:
        """The name in the peer's certificate; empty on a plain connection."""
        return "" if self._tls is None else self._tls.name

    @property
    def serial(self) -> bytes:
        """The serial number of the peer's certificate; empty on a plain connection."""
        return b"" if self._tls is None else self._tls.serial

    @property
    def waiting_bytes(self) -> int:
        return 0 if self._queue is None else len(self._queue)

    def expect_silence(self, seconds: int) -> None:
        """Let the kernel probe the peer only after this long without data."""
        with suppress(OSError):
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPIDLE, seconds)

    def is_idle(self, now_s: float) -> bool:
        return now_s - self.last_rx_s > IDLE_S and now_s - self.last_tx_s > IDLE_S

    def on_ready(self, events: int) -> None:
        """Read or write as far as the socket permits."""
        if events & ~READ or self.paused_s is not None or self.failure is not None:
            self._on_rare(events)
            return
        # The path of every relayed line: avoid every unnecessary call.
        try:
            chunk = self._socket.recv(_READ_BYTES)
        except OSError as error:
            self._on_error(error)
            return
        if not chunk:
            self.fail("closed by the peer")
            return
        self.last_rx_s = self._poller.now_s
        if self.partial is None and chunk[-1] == 0x0A:
            self.owner.on_lines(self, chunk)
        else:
            self._assemble(chunk)

    def _on_rare(self, events: int) -> None:
        """Handle events other than plain readable: writable, paused, broken."""
        if self.failure is not None:
            return
        if self.paused_s is not None:
            if events & ~WRITE:
                self.fail("gone")
        elif events & select.EPOLLIN:
            self.on_ready(select.EPOLLIN)
        elif events & ~WRITE:
            self.fail("lost")
        if events & WRITE and self.failure is None:
            self._write()

    def _on_error(self, error: OSError) -> int:
        """End the connection unless the socket was merely not ready; return 0 bytes."""
        if not isinstance(error, BlockingIOError | InterruptedError):
            self.fail(error.strerror or "lost")
        return 0

    def _assemble(self, chunk: bytes) -> None:
        if self.partial is None:
            self.partial = LineBuffer()
        partial = self.partial
        lines = partial.feed(chunk)
        if not partial:
            self.partial = None
        if lines:
            self.owner.on_lines(self, lines)
        if self.partial is partial and self.failure is None:
            if len(partial) > LINE_MAX_BYTES:
                self.fail(f"a line longer than {LINE_MAX_BYTES} bytes")
            else:
                self.owner.on_partial_line(self)

    def relay(self, lines: bytes) -> int:
        """Send whole lines; return how many old ones were dropped to make room."""
        queue = self._queue
        if queue is None:
            try:
                sent = self._socket.send(lines)
            except OSError as error:
                sent = self._on_error(error)
            if sent == len(lines):
                self.last_tx_s = self._poller.now_s
                return 0
            self._keep(lines[sent:], sent)
            return 0
        before = queue.dropped_lines
        queue.put(lines)
        return queue.dropped_lines - before

    def relay_paced(self, lines: bytes) -> bool:
        """Send whole lines; return whether the sender may continue."""
        queue = self._queue
        if queue is None:
            try:
                sent = self._socket.send(lines)
            except OSError as error:
                sent = self._on_error(error)
            if sent == len(lines):
                self.last_tx_s = self._poller.now_s
                return True
            self._keep(lines[sent:], sent)
            queue = self._queue
        else:
            queue.put(lines)
        return queue is None or len(queue) < HIGH_WATER_BYTES

    def send(self, line: bytes) -> None:
        """Send a control line, between relayed lines."""
        queue = self._queue
        if queue is None:
            self.relay(line)
            return
        queue.put_control(line)
        if queue.kept_bytes > _KEPT_MAX_BYTES:
            self.fail("does not read")

    def _keep(self, rest: bytes, sent: int) -> None:
        if self.failure is None:
            if sent:
                self.last_tx_s = self._poller.now_s
            self._queue = SendBuffer(self.queue_bytes)
            self._queue.put_rest(rest)
            if self._tls is not None:
                self._queue.keep(self._tls.attempted)
            self._watch()

    def _write(self) -> None:
        queue = self._queue
        if queue is None:
            return
        try:
            sent = self._socket.send(queue.head())
        except OSError as error:
            self._on_error(error)
            if self._tls is not None:
                queue.keep(self._tls.attempted)
            return
        self.last_tx_s = self._poller.now_s
        queue.sent(sent)
        if not queue:
            self._queue = None
            self._watch()
            self.owner.on_drained(self)

    def pause(self) -> None:
        """Stop reading until `resume`: the receiver of its data is slow."""
        if self.paused_s is None:
            self.paused_s = self._poller.now_s
            self._watch()

    def resume(self) -> None:
        if self.paused_s is not None:
            self.paused_s = None
            self._watch()

    def _watch(self) -> None:
        events = READ if self.paused_s is None else PAUSED
        if self._queue is not None:
            events |= WRITE
        if events != self._events and self.failure is None:
            self._events = events
            self._poller.change(self._socket.fileno(), events)

    def refuse(self, line: bytes, reason: str) -> None:
        """Send a last line and close the output; the owner ends the connection soon.

        An immediate close would reset a connection with unread bytes, and the peer would not
        receive the reason.
        """
        self.relay(line)
        if self.failure is None:
            try:
                self._socket.shutdown(socket.SHUT_WR)
            except OSError:
                self.fail(reason)

    def fail(self, reason: str) -> None:
        """Request the end of the connection; the first reason counts."""
        if self.failure is None:
            self.failure = reason
            self._poller.end_later(self)

    def end(self) -> None:
        self._poller.discard(self._socket.fileno())
        self._socket.close()
        self._queue = None
        self.partial = None
        self._closed(self)
        self.owner.on_end(self, self.failure or "closed")
