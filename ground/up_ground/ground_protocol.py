"""One connection of a ground station: hello, lines, heartbeat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from twisted.internet.protocol import Protocol, connectionDone
from twisted.python.failure import Failure

from up.protocols.line_decoder import LineDecoder
from up.protocols.proxy_lines import PREFIX
from up.protocols.tcp_options import answered, watch_peer
from up.system.clock import Clock, Timer, cancel
from up.tls.errors import TLSError

if TYPE_CHECKING:
    from up_ground.ground_link import GroundLink

USER_TIMEOUT_MS = 1500
HEARTBEAT_S = 1.0
HELLO_TIMEOUT_S = 5.0


class GroundProtocol(Protocol):
    """Splits the stream into lines and keeps the connection alive; one instance per connection.

    A ``hello`` is sent first and must be answered within ``HELLO_TIMEOUT_S`` (``accept`` reports
    the answer); then an empty line follows each second without output.
    Without a hello only the input of `send` goes out: a thesis peer knows no heartbeat.
    """

    transport: Any

    def __init__(self, clock: Clock, owner: GroundLink, hello: bytes | None) -> None:
        self._clock = clock
        self._owner = owner
        self._hello = hello
        self._lines = LineDecoder()
        self._told_s = 0.0
        self._timer: Timer | None = None
        self._is_open = False
        self._reason = ("", "")

    @property
    def dropped_too_long(self) -> int:
        return self._lines.dropped_too_long

    def send(self, line: bytes) -> bool:
        if not self._is_open:
            return False
        self._told_s = self._clock.seconds()
        self.transport.write(line)
        return True

    def accept(self) -> None:
        """Accept the answer to the hello: heartbeats begin."""
        self._schedule(HEARTBEAT_S, self._beat)

    def abort(self, reason: str, code: str) -> None:
        """Abort the connection; the owner gets the first reason and its code."""
        self._reason = self._reason if self._reason[0] else (reason, code)
        self._is_open = False
        self.transport.abortConnection()

    def close(self) -> None:
        self._is_open = False
        self.transport.loseConnection()

    def round_trip_ms(self) -> float | None:
        """Return the kernel's smoothed round trip to the peer; None if not available."""
        answer = answered(self.transport) if self._is_open else None
        return None if answer is None else answer.round_trip_s * 1000

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        watch_peer(self.transport, USER_TIMEOUT_MS)
        self._is_open = True
        if self._hello is not None:
            self._schedule(HELLO_TIMEOUT_S, self._on_no_answer)
            self.send(self._hello)
        self._owner.on_made(self)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        """Hand on the lines that ``data`` completes, the proxy's apart from the aircraft's."""
        for line in self._lines.feed(data):
            if not self._is_open:
                return
            if line.startswith(PREFIX):
                self._owner.on_control(self, line)
            else:
                self._owner.on_line(self, line)

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802 - Twisted's name
        """Report the lost connection; an unfinished line is dropped."""
        self._is_open = False
        self._lines.reset()
        cancel(self._timer)
        code = reason.value.code if isinstance(reason.value, TLSError) else "lost"
        text, code = self._reason if self._reason[0] else (reason.getErrorMessage(), code)
        self._owner.on_lost(self, text, code)

    def _on_no_answer(self) -> None:
        self.abort(
            f"no answer to the hello within {HELLO_TIMEOUT_S:g} s: is this the ground port of a"
            " Ground Station Proxy? (--direct sends no hello)",
            "no_hello_answer",
        )

    def _beat(self) -> None:
        rest_s = self._told_s + HEARTBEAT_S - self._clock.seconds()
        if rest_s <= 0:
            self.send(b"\n")
            rest_s = HEARTBEAT_S
        self._schedule(rest_s, self._beat)

    def _schedule(self, delay_s: float, call: Any) -> None:
        cancel(self._timer)
        self._timer = self._clock.callLater(delay_s, call)
