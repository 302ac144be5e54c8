"""A TCP connection that carries General Messages."""

from collections.abc import Callable
from typing import Any
from typing import Protocol as Interface

from twisted.internet.protocol import Protocol, connectionDone
from twisted.logger import Logger
from twisted.python.failure import Failure

from up.protocols.binary_line import TYPES
from up.protocols.general_message import GeneralMessage, MalformedMessage, decode
from up.protocols.line_decoder import MAX_LINE_BYTES, LineDecoder
from up.protocols.link_output import LinkOutput, Make
from up.protocols.proxy_lines import PREFIX
from up.protocols.tcp_options import watch_peer, why_lost
from up.system.clock import Clock, Timer, cancel
from up.system.token_bucket import TokenBucket

USER_TIMEOUT_MS = 1500
MAX_MESSAGES_HZ = 300.0
MAX_BURST = 150
"""Messages of one link beyond its rate and burst are dropped before they are decoded."""
CLOSING_LIMIT_S = 1.0


class GeneralMessageLink(Interface):
    """The link that the callbacks receive, on TCP and UDP alike."""

    @property
    def peer(self) -> str:
        """Host and port of the peer as text; empty without a peer."""

    @property
    def heard_s(self) -> float:
        """The clock's time of the peer's newest byte or datagram."""

    def send(self, message: bytes) -> bool:
        """Send an encoded message in order; False if it was dropped and counted."""

    def send_newest(self, message: bytes) -> bool:
        """Send an encoded message that replaces an older one still waiting."""

    def close(self) -> None:
        """Close the link."""


_log = Logger()
OnMessage = Callable[[Any, GeneralMessage], object]
OnMalformed = Callable[[Any, MalformedMessage], object]
OnConnected = Callable[[Any], object]
OnLost = Callable[[Any, str], object]
OnBinary = Callable[[Any, bytes], object]


def permits(bucket: TokenBucket, peer: str, waiting: int = 1) -> bool:
    """Take a token for the next of ``waiting`` messages; without one, drop all: False.

    The first drop is logged; `bucket.refused` counts.
    """
    is_first = not bucket.refused
    if bucket.take():
        return True
    bucket.refused += waiting - 1
    if is_first:
        _log.warn(
            "{peer} sends more than {rate:g} messages a second: the excess is dropped and counted",
            peer=peer,
            rate=MAX_MESSAGES_HZ,
            code="rate_exceeded",
        )
    return False


class GeneralMessageProtocol(Protocol):
    """One connection; create a new one for each.

    Every callback gets this link as its first argument: `on_message` also a message, `on_malformed`
    an invalid line, `on_connected` nothing else, `on_lost` the reason as text, `on_binary` a line
    that is not JSON (up/protocols/binary_line.py), which is malformed without it. Counters:
    `malformed`, `output.dropped`, `output.replaced`, `dropped_too_long` and `bucket.refused`; the
    connections of one peer may share `bucket`. A line of more than `longest_line` bytes is
    malformed.
    """

    transport: Any

    def __init__(
        self,
        clock: Clock,
        *,
        on_message: OnMessage,
        on_malformed: OnMalformed,
        on_connected: OnConnected,
        on_lost: OnLost,
        on_binary: OnBinary | None = None,
        user_timeout_ms: int = USER_TIMEOUT_MS,
        bucket: TokenBucket | None = None,
    ) -> None:
        self.peer = ""
        self.output = LinkOutput()
        self.bucket = bucket or TokenBucket(clock, MAX_MESSAGES_HZ, MAX_BURST)
        self.malformed = 0
        self.longest_line = MAX_LINE_BYTES
        self._clock = clock
        self._on_message = on_message
        self._on_malformed = on_malformed
        self._on_connected = on_connected
        self._on_lost = on_lost
        self._on_binary = on_binary
        self._user_timeout_ms = user_timeout_ms
        self._lines = LineDecoder()
        self._heard_s = 0.0
        self._timer: Timer | None = None
        self._is_open = False
        self._why_given_up = ""

    @property
    def dropped_too_long(self) -> int:
        """Count of lines of more than 16 KiB."""
        return self._lines.dropped_too_long

    @property
    def heard_s(self) -> float:
        """The clock's time of the newest byte from the peer."""
        return self._heard_s

    def send(self, message: bytes) -> bool:
        """Send `message` in order; False without a link, or when 64 KiB wait already."""
        return self.output.send(message)

    def send_newest(self, message: bytes | Make) -> bool:
        """Send `message`; a slow peer gets only the newest. A function makes it when it leaves."""
        return self.output.send_newest(message)

    def close(self) -> None:
        if self._is_open:
            self._is_open = False
            self.output.finish()
            self._timer = self._clock.callLater(CLOSING_LIMIT_S, self.abort)
            self.transport.loseConnection()

    def abort(self) -> None:
        self._is_open = False
        if self.transport is not None:
            self.transport.abortConnection()

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        address = self.transport.getPeer()
        self.peer = f"{address.host}:{address.port}"
        watch_peer(self.transport, self._user_timeout_ms)
        self._is_open = True
        self._heard_s = self._clock.seconds()
        self.output.start(self.transport)
        self._on_connected(self)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        self._heard_s = self._clock.seconds()
        lines = self._lines.feed(data)
        for index, line in enumerate(lines):
            if not self._is_open:
                return
            if line.startswith(PREFIX) and self._on_control(line):
                continue
            if not permits(self.bucket, self.peer, len(lines) - index):
                return
            if self._on_binary is not None and line[0] in TYPES:
                self._on_binary(self, line)
                continue
            try:
                message = decode(line, self.longest_line)
            except MalformedMessage as fault:
                self.malformed += 1
                self._on_malformed(self, fault)
            else:
                self._on_message(self, message)

    def _on_control(self, line: bytes) -> bool:
        """Take a control line of a proxy; False: it is none here."""
        return False

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802 - Twisted's name
        self._is_open = False
        self._lines.reset()
        cancel(self._timer)
        self._on_lost(self, self._why_given_up or why_lost(reason))
