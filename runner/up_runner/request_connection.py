"""One connection to the request port: JSON lines, or a legacy client that sends any bytes."""

from __future__ import annotations

import enum
from typing import TYPE_CHECKING, Any

from twisted.internet.interfaces import IHalfCloseableProtocol
from twisted.internet.protocol import Protocol, connectionDone
from twisted.python.failure import Failure
from zope.interface import implementer

from up.protocols.aircraft_sessions import AircraftSessions
from up.protocols.runner_session import RUNNER
from up_runner.request import MAX_LINE, MalformedRequest, Request, parse
from up_runner.response import BUG, Problem, Response
from up_runner.watchdog import Watchdog

if TYPE_CHECKING:
    from up_runner.request_server import RequestServer

SILENCE_S = 1.0
UNFINISHED_S = 10.0
CLOSE_S = 1.0


class Dialect(enum.Enum):
    """The protocol of a connection, determined by its first byte."""

    UNKNOWN = "unknown"
    LINES = "lines"
    LEGACY = "legacy"


@implementer(IHalfCloseableProtocol)
class RequestConnection(Protocol):
    """One client. Handles one request at a time and reads nothing in the meantime."""

    transport: Any

    def __init__(self, server: RequestServer, host: str) -> None:
        self.host = host
        self.last_rx_s = 0.0
        self.busy = False
        self.sessions = AircraftSessions(RUNNER, lambda: round(server.clock.seconds() * 1000))
        """Those of this connection: no other one can use or end them."""
        self._server = server
        self._dialect = Dialect.UNKNOWN
        self._buffer = bytearray()
        self._searched = 0
        """Bytes of the buffer known to hold no line feed."""
        self._closing = False
        self._answered = False
        self._idle = Watchdog(server.clock, server.limits.idle_s, self._on_idle)
        self._unfinished = Watchdog(server.clock, UNFINISHED_S, self._on_unfinished)
        self._silence = Watchdog(server.clock, SILENCE_S, self._on_silence)
        self._closer = Watchdog(server.clock, CLOSE_S, self.drop)
        self._output_full = False
        self._parsing = False
        self._input_ended = False

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        self.transport.setTcpNoDelay(True)
        self.transport.registerProducer(self, True)
        self._on_activity()

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        """Remove the client; its request continues."""
        self._closing = True
        self._stop_timers()
        self._server.on_gone(self)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        if self._closing:
            return
        self._on_activity()
        if self._dialect is Dialect.UNKNOWN:
            self._dialect = Dialect.LINES if data.startswith(b"{") else Dialect.LEGACY
        if self._dialect is Dialect.LEGACY:
            # Whatever it sends, it requests the one nameless instance.
            if not self.busy:
                self._handle(Request())
            return
        self._buffer += data
        self._handle_lines()

    def readConnectionLost(self) -> None:  # noqa: N802 - Twisted's name
        """Handle a client that sends no more but still reads, as `nc -N` does."""
        self._input_ended = True
        self._set_reading()
        if self.busy or self._closing:
            return
        if self._buffer and not self._answered:
            self._silence.stop()
            self._on_silence()
        else:
            self.transport.loseConnection()

    def writeConnectionLost(self) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: this end closed its side."""

    def pauseProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Stop reading from a client that does not read our answers."""
        self._output_full = True
        self._set_reading()

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        self._output_full = False
        self._set_reading()

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: the connection is lost."""

    def drop(self) -> None:
        self._closing = True
        self.transport.abortConnection()

    def _handle_lines(self) -> None:
        if self._parsing:
            return
        self._parsing = True
        self._silence.stop()
        while not self.busy and not self._closing:
            end = self._buffer.find(b"\n", self._searched)
            self._searched = len(self._buffer) if end < 0 else 0
            if max(end, self._searched) > MAX_LINE:
                self._reject("too_long", f"the request is longer than {MAX_LINE} bytes")
                self._close()
            elif end < 0:
                self._wait_for_more()
                break
            else:
                self._unfinished.stop()
                line = bytes(self._buffer[:end])
                del self._buffer[: end + 1]
                self._handle_line(line)
        self._parsing = False

    def _handle_line(self, line: bytes) -> None:
        if not line.strip():
            return
        try:
            request = parse(line)
        except MalformedRequest as error:
            self._reject("malformed_request", str(error))
        else:
            self._handle(request)

    def _wait_for_more(self) -> None:
        """An incomplete first line belongs to a legacy client; a later one is ignored."""
        if not self._buffer:
            return
        if not self._unfinished.running:
            # Counted from its first byte: sending byte by byte gains no time.
            self._unfinished.reset()
        if not self._answered:
            self._silence.reset()

    def _on_silence(self) -> None:
        line, self._buffer, self._searched = bytes(self._buffer), bytearray(), 0
        try:
            # A complete request without its line feed is still a request.
            request = parse(line)
        except MalformedRequest:
            self._dialect = Dialect.LEGACY
            request = Request()
        self._handle(request)

    def _on_unfinished(self) -> None:
        self._reject("unfinished", f"the request was not finished within {UNFINISHED_S:g} s")
        self._close()

    def _handle(self, request: Request) -> None:
        self.busy = True
        self._idle.stop()
        self._unfinished.stop()
        self._set_reading()
        self._server.handle(self, request).addBoth(self._on_response, request)

    def _on_response(self, line: bytes | Failure, request: Request) -> None:
        self.busy = False
        if isinstance(line, Failure):
            self._server.log.failure("a bug in the runner", line, code="runner_bug")
            line = self._server.encode(Response(request.aircraft, error=BUG), self.host)
        if self._closing:
            return
        self._on_activity()
        self._write(line)
        self._set_reading()
        if self._dialect is Dialect.LINES:
            self._handle_lines()
        if self._input_ended and not self.busy and not self._parsing:
            self.transport.loseConnection()

    def _reject(self, code: str, text: str) -> None:
        self._server.counts["malformed"] += 1
        self._write(self._server.encode(Response(None, error=Problem(code, text)), self.host))

    def _write(self, line: bytes) -> None:
        self._answered = True
        self.transport.write(line)

    def _close(self) -> None:
        """Send the answer, read nothing more, and close soon."""
        self._closing = True
        self._buffer.clear()
        self._searched = 0
        self._stop_timers()
        self._set_reading()
        self.transport.unregisterProducer()
        self.transport.loseWriteConnection()
        self._closer.reset()

    def _set_reading(self) -> None:
        if self.busy or self._output_full or self._closing or self._input_ended:
            self.transport.pauseProducing()
        else:
            self.transport.resumeProducing()

    def _on_activity(self) -> None:
        self.last_rx_s = self._server.clock.seconds()
        self._idle.reset()

    def _on_idle(self) -> None:
        self._server.counts["idle"] += 1
        self.drop()

    def _stop_timers(self) -> None:
        for each in (self._idle, self._unfinished, self._silence, self._closer):
            each.stop()
