"""The request port: JSON lines, and thesis clients that say anything at all."""

from __future__ import annotations

import enum
from collections import Counter
from collections.abc import Callable
from typing import Any, cast

from twisted.internet.defer import Deferred
from twisted.internet.protocol import Factory, Protocol, connectionDone
from twisted.logger import Logger
from twisted.python.failure import Failure

from up.log import Limited
from up.system.addresses import is_private, plain
from up.system.clock import Clock, Timer
from up_runner.answer import Answer
from up_runner.deadline import Deadline
from up_runner.request import MAX_LINE, MalformedRequest, Request, parse

SILENCE_S = 1.0
CLOSE_S = 1.0
SAID_AGAIN_S = 10.0
Ask = Callable[[Request], Deferred[Answer]]


class Speech(enum.Enum):
    """How a connection speaks, which its first byte decides."""

    UNKNOWN = "unknown"
    LINES = "lines"
    THESIS = "thesis"


class RequestConnection(Protocol):
    """One asker. One request at a time is worked on; meanwhile nothing more is read."""

    transport: Any

    def __init__(self, server: RequestServer, host: str) -> None:
        self.host = host
        self.heard_s = 0.0
        self.busy = False
        self._server = server
        self._speech = Speech.UNKNOWN
        self._buffer = bytearray()
        self._searched = 0
        """Bytes of the buffer in which no line feed is."""
        self._closing = False
        self._answered = False
        self._idle = Deadline(server.clock, server.idle_s, self._on_idle)
        self._silence: Timer | None = None
        self._reader_full = False

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        """Begin to wait for the first byte."""
        self.transport.setTcpNoDelay(True)
        self.transport.registerProducer(self, True)
        self._touch()

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        """Forget the asker; what it asked for goes on."""
        self._closing = True
        self._idle.stop()
        self._cancel_silence()
        self._server.on_gone(self)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        """Take what came."""
        if self._closing:
            return
        self._touch()
        if self._speech is Speech.UNKNOWN:
            self._speech = Speech.LINES if data.startswith(b"{") else Speech.THESIS
        if self._speech is Speech.THESIS:
            # Whatever it says, it asks for the one nameless instance.
            if not self.busy:
                self._ask(Request())
            return
        self._buffer += data
        self._take_lines()

    def pauseProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Read no more from one who does not read our answers."""
        self._reader_full = True
        self._set_reading()

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Read again."""
        self._reader_full = False
        self._set_reading()

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: the connection is lost."""

    def drop(self) -> None:
        """End the connection now."""
        self._closing = True
        self.transport.abortConnection()

    def _take_lines(self) -> None:
        self._cancel_silence()
        while not self.busy and not self._closing:
            end = self._buffer.find(b"\n", self._searched)
            self._searched = len(self._buffer) if end < 0 else 0
            if max(end, self._searched) > MAX_LINE:
                self._refuse(f"the request is longer than {MAX_LINE} bytes")
                self._close()
            elif end < 0:
                self._wait_for_more()
                return
            else:
                line = bytes(self._buffer[:end])
                del self._buffer[: end + 1]
                self._take(line)

    def _take(self, line: bytes) -> None:
        if not line.strip():
            return
        try:
            request = parse(line)
        except MalformedRequest as error:
            self._refuse(str(error))
        else:
            self._ask(request)

    def _wait_for_more(self) -> None:
        """A first line that stays unfinished is a thesis client's; a later one is nothing."""
        if self._buffer and not self._answered:
            self._silence = self._server.clock.callLater(SILENCE_S, self._on_silence)

    def _on_silence(self) -> None:
        self._silence = None
        line, self._buffer, self._searched = bytes(self._buffer), bytearray(), 0
        try:
            # A whole request whose line feed was forgotten says what it wants.
            request = parse(line)
        except MalformedRequest:
            self._speech = Speech.THESIS
            request = Request()
        self._ask(request)

    def _ask(self, request: Request) -> None:
        self.busy = True
        self._idle.stop()
        self._set_reading()
        self._server.ask(self, request).addBoth(self._on_answer, request)

    def _on_answer(self, answer: Answer | Failure, request: Request) -> None:
        self.busy = False
        if isinstance(answer, Failure):
            self._server.log.failure("a bug in the runner", answer)
            answer = Answer(request.aircraft, error="the runner failed, see its log")
        if self._closing:
            return
        self._touch()
        self._write(answer)
        self._set_reading()
        if self._speech is Speech.LINES:
            self._take_lines()

    def _refuse(self, error: str) -> None:
        self._server.counts["malformed"] += 1
        self._write(Answer(None, error=error))

    def _write(self, answer: Answer) -> None:
        self._answered = True
        self.transport.write(self._server.encode(answer, self.host))

    def _close(self) -> None:
        """Let the answer through, hear nothing more, and end it soon."""
        self._closing = True
        self._buffer.clear()
        self._searched = 0
        self._idle.stop()
        self._set_reading()
        self.transport.unregisterProducer()
        self.transport.loseWriteConnection()
        self._silence = self._server.clock.callLater(CLOSE_S, self.drop)

    def _set_reading(self) -> None:
        if self.busy or self._reader_full or self._closing:
            self.transport.pauseProducing()
        else:
            self.transport.resumeProducing()

    def _touch(self) -> None:
        self.heard_s = self._server.clock.seconds()
        self._idle.touch()

    def _on_idle(self) -> None:
        self._server.counts["idle"] += 1
        self.drop()

    def _cancel_silence(self) -> None:
        silence, self._silence = self._silence, None
        if silence is not None and silence.active():
            silence.cancel()


class RequestServer(Factory):
    """Accepts askers within limits and hands their requests to `ask`.

    A public peer is turned away unless `accept_public`. `counts` tells what was refused and why.
    """

    noisy = False

    def __init__(
        self,
        clock: Clock,
        ask: Ask,
        encode: Callable[[Answer, str], bytes],
        *,
        limit: int,
        address_limit: int,
        idle_s: float,
        accept_public: bool,
    ) -> None:
        self.clock = clock
        self.idle_s = idle_s
        self.encode = encode
        self.counts: Counter[str] = Counter()
        self.log = Logger(namespace="runner.requests")
        self._ask = ask
        self._limit = limit
        self._address_limit = address_limit
        self._accept_public = accept_public
        self._limited = Limited(cast(Any, clock), SAID_AGAIN_S)
        self._connections: set[RequestConnection] = set()
        self._by_host: Counter[str] = Counter()

    def __len__(self) -> int:
        return len(self._connections)

    def buildProtocol(self, addr: Any) -> RequestConnection | None:  # noqa: N802
        """Return a connection for a peer, None to turn it away."""
        host = plain(addr.host)
        if not self._accept_public and not is_private(host):
            self._turn_away(
                "public", host, "is a public address; i_accept_plain: true in runner.yml lets it in"
            )
            return None
        if self._by_host[host] >= self._address_limit:
            self._turn_away("address limit", host, "has too many connections")
            return None
        if len(self._connections) >= self._limit and not self._make_room():
            self._turn_away("limit", host, "comes when all connections are taken")
            return None
        connection = RequestConnection(self, host)
        connection.factory = self
        self._connections.add(connection)
        self._by_host[host] += 1
        return connection

    def ask(self, connection: RequestConnection, request: Request) -> Deferred[Answer]:
        """Let a request be answered."""
        self._limited.log(
            self.log.info,
            "{host} asks: {action} {aircraft}",
            key=(connection.host, request.action, request.aircraft),
            host=connection.host,
            action=request.action,
            aircraft=request.aircraft,
        )
        return self._ask(request)

    def on_gone(self, connection: RequestConnection) -> None:
        """Forget a connection."""
        if connection in self._connections:
            self._connections.discard(connection)
            self._by_host[connection.host] -= 1
            if not self._by_host[connection.host]:
                del self._by_host[connection.host]

    def close(self) -> None:
        """End every connection."""
        for connection in list(self._connections):
            connection.drop()
        self._limited.stop()

    def _make_room(self) -> bool:
        """Drop the connection that was silent longest; those that wait for an answer stay."""
        silent = [each for each in self._connections if not each.busy]
        if not silent:
            return False
        oldest = min(silent, key=lambda each: each.heard_s)
        self.counts["made room"] += 1
        self.on_gone(oldest)
        oldest.drop()
        return True

    def _turn_away(self, why: str, host: str, what: str) -> None:
        self.counts[why] += 1
        self._limited.log(
            self.log.warn, "turned away {host}: it {what}", key=why, host=host, what=what
        )
