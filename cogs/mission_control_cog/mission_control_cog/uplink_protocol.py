"""One connection to the proxy: hello, answer, then General Messages."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.internet.protocol import connectionDone
from twisted.python.failure import Failure

from up.protocols.binary_line import to_line
from up.protocols.general_message_link import GeneralMessageProtocol
from up.protocols.link_output import Make
from up.protocols.packed_telemetry import IsEnough, Packer
from up.protocols.proxy_lines import (
    HELLO_MAX_BYTES,
    TOKEN,
    Accepted,
    Hello,
    Refused,
    Watchers,
    parse_line,
)
from up.protocols.tcp_options import KEEPALIVE_IDLE_S, ip_bytes, set_option
from up.system.clock import Clock, Timer, cancel
from up.tls.errors import TLSError

HEARTBEAT_S = 1.0
UNWATCHED_HEARTBEAT_S = 12.0
"""Of a link that no ground watches; also the kernel's pause before a probe."""
ANSWER_LIMIT_S = 5.0
SILENCE_S, UNWATCHED_SILENCE_S = 12.0, 25.0
"""A proxy that tells of watchers sends something every 5 s, without grounds every 10 s."""


class UplinkProtocol(GeneralMessageProtocol):
    """General Messages after a hello; without ``hello`` immediately (legacy client).

    ``on_token`` gets the token for the next hello, empty when the proxy refuses it: the name may
    belong to another aircraft. ``on_ready`` gets the link when messages can be sent. ``lost_code``
    is the code of the loss. A link with hello sends an empty line after ``heartbeat_s`` without
    other data, more rarely without any ground. ``watchers`` stays None at a proxy that does not
    tell.
    """

    def __init__(
        self,
        clock: Clock,
        hello: Hello | None,
        *,
        on_token: Callable[[str], object],
        on_ready: Callable[[UplinkProtocol], object],
        heartbeat_s: float = HEARTBEAT_S,
        **callbacks: Any,
    ) -> None:
        super().__init__(clock, on_connected=self._begin, **callbacks)
        self.is_ready = False
        self.lost_code = "link_lost"
        self.watchers: Watchers | None = None
        self._packer = Packer()
        self._hello = hello
        self._on_token = on_token
        self._on_ready = on_ready
        self._heartbeat_s = heartbeat_s
        self._answer = b""
        self._sent_s = 0.0
        self._pulse: Timer | None = None

    def send(self, message: bytes) -> bool:
        """Send ``message`` in order; False if not ready, or if too much waits."""
        if not self.is_ready:
            self.output.dropped += 1
            return False
        self._sent_s = self._clock.seconds()
        return super().send(message)

    @property
    def is_unwatched(self) -> bool:
        """Return whether the proxy counts no ground."""
        return self.watchers is not None and not self.watchers.grounds

    @property
    def may_pack(self) -> bool:
        """Return whether every ground reads packed telemetry."""
        return self.watchers is not None and bool(self.watchers.packed)

    @property
    def may_shorten(self) -> bool:
        """Return whether every ground reads attitude frames."""
        return self.watchers is not None and bool(self.watchers.attitude)

    def ip_bytes(self) -> int | None:
        """Return the bytes of this connection so far, both ways with headers; None: not known."""
        return ip_bytes(self.transport)

    def send_newest(self, message: bytes | Make) -> bool:
        if not self.is_ready:
            return False
        self._sent_s = self._clock.seconds()
        return super().send_newest(message)

    def send_packed(
        self,
        frame: bytes,
        lines: Callable[[bytes], bytes] = to_line,
        whole_s: float = 0.0,
        is_enough: IsEnough | None = None,
    ) -> bool:
        """Send a frame of telemetry, a line, packed when it leaves; ``lines`` is of its body.

        ``whole_s`` and ``is_enough`` are those of Packer.pack.
        """

        def pack() -> bytes:
            body = self._packer.pack(frame[:-1], self._clock.seconds(), whole_s, is_enough)
            # A link that sends nothing would not ask for more.
            return lines(body) or b"\n"

        return self.send_newest(pack)

    def _on_control(self, line: bytes) -> bool:
        said = parse_line(line)
        if self._hello is None or not isinstance(said, Watchers):
            return False
        was_unwatched = self.is_unwatched
        self.watchers = said
        self._packer.restart()
        if self.is_unwatched != was_unwatched:
            idle_s = int(UNWATCHED_HEARTBEAT_S) if self.is_unwatched else KEEPALIVE_IDLE_S
            set_option(self.transport, "TCP_KEEPIDLE", idle_s)
            cancel(self._pulse)
            self._pulse = self._clock.callLater(0, self._beat)
        return True

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        """Take the answer to the hello, then messages."""
        if self.is_ready or self._hello is None:
            super().dataReceived(data)
            return
        self._heard_s = self._clock.seconds()
        self._answer, ended, rest = (self._answer + data).partition(b"\n")
        if len(self._answer) >= HELLO_MAX_BYTES:
            self._give_up("answer_too_long", "its answer to the hello is too long")
        elif ended and self._on_answer(self._answer) and rest:
            super().dataReceived(rest)

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802 - Twisted's name
        self.is_ready = False
        cancel(self._pulse)
        if isinstance(reason.value, TLSError):
            self.lost_code = reason.value.code
        super().connectionLost(reason)

    def close(self) -> None:
        self.is_ready = False
        super().close()

    def _begin(self, link: GeneralMessageProtocol) -> None:
        if self._hello is None:
            self._ready()
            return
        self._pulse = self._clock.callLater(ANSWER_LIMIT_S, self._on_timeout)
        super().send(self._hello.encode())

    def _on_answer(self, line: bytes) -> bool:
        """Return whether the proxy accepted the hello, so that messages may follow."""
        answer = parse_line(line)
        if isinstance(answer, Accepted):
            self._on_token(answer.token)
            self._ready()
            return True
        if isinstance(answer, Refused):
            if answer.code == TOKEN:
                self._on_token("")
            self._give_up(
                f"proxy_refused_{answer.code}",
                f"the proxy refused: {answer.reason} ({answer.code})",
            )
        else:
            self._give_up(
                "not_an_answer",
                "it does not answer the hello (a legacy proxy? mission_control.yml: hello)",
            )
        return False

    def _on_timeout(self) -> None:
        self._give_up("answer_timeout", f"no answer to the hello within {ANSWER_LIMIT_S:g} s")

    def _give_up(self, code: str, reason: str) -> None:
        self.lost_code = code
        self._why_given_up = reason
        self.abort()

    def _ready(self) -> None:
        cancel(self._pulse)
        self.is_ready = True
        self._sent_s = self._clock.seconds()
        if self._hello is not None:
            self._pulse = self._clock.callLater(self._heartbeat_s, self._beat)
        self._on_ready(self)

    def _beat(self) -> None:
        limit_s = UNWATCHED_SILENCE_S if self.is_unwatched else SILENCE_S
        if self.watchers is not None and self._clock.seconds() - self._heard_s > limit_s:
            # A relay on the way may acknowledge what it cannot pass on.
            self._give_up("proxy_silent", "the proxy is silent")
            return
        period_s = UNWATCHED_HEARTBEAT_S if self.is_unwatched else self._heartbeat_s
        silence_s = self._clock.seconds() - self._sent_s
        if silence_s >= period_s:
            self.send(b"\n")
            silence_s = 0.0
        self._pulse = self._clock.callLater(period_s - silence_s, self._beat)
