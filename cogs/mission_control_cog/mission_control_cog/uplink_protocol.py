"""One connection to the proxy: hello, answer, then General Messages."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.internet.protocol import connectionDone
from twisted.python.failure import Failure

from mission_control_cog.hello import HELLO_MAX_BYTES, HelloAnswer, hello_line, parse_answer
from up.protocols.general_message_link import GeneralMessageProtocol
from up.system.clock import Clock, Timer

HEARTBEAT_S = 1.0
ANSWER_LIMIT_S = 5.0


class UplinkProtocol(GeneralMessageProtocol):
    """General Messages after a hello; without ``hello`` immediately (thesis client).

    ``on_ready`` gets the link when messages can be sent; ``on_answer`` gets the proxy's answer
    before that. A link with hello sends an empty line in every second without other data.
    """

    def __init__(
        self,
        clock: Clock,
        hello: tuple[str, str] | None,
        *,
        on_answer: Callable[[HelloAnswer], object],
        on_ready: Callable[[UplinkProtocol], object],
        **callbacks: Any,
    ) -> None:
        super().__init__(clock, on_connected=self._begin, **callbacks)
        self._hello = hello
        self._on_answer = on_answer
        self._on_ready = on_ready
        self._is_ready = False
        self._answer = b""
        self._sent_s = 0.0
        self._pulse: Timer | None = None

    @property
    def is_ready(self) -> bool:
        """Return whether messages can be sent."""
        return self._is_ready

    def send(self, message: bytes) -> bool:
        """Send ``message`` in order; False if not ready, or if too much waits."""
        if not self._is_ready:
            self.output.dropped += 1
            return False
        self._sent_s = self._clock.seconds()
        return super().send(message)

    def send_newest(self, message: bytes) -> bool:
        """Send ``message``; a slow peer gets only the newest."""
        if not self._is_ready:
            return False
        self._sent_s = self._clock.seconds()
        return super().send_newest(message)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        """Take the answer to the hello, then messages."""
        if self._is_ready or self._hello is None:
            super().dataReceived(data)
            return
        self._heard_s = self._clock.seconds()
        line, ended, rest = (self._answer + data).partition(b"\n")
        if len(line) >= HELLO_MAX_BYTES or not ended:
            self._answer = line
            if len(line) >= HELLO_MAX_BYTES:
                self._give_up("its answer to the hello is too long")
            return
        answer = parse_answer(line)
        if answer is None:
            self._give_up("it does not answer the hello (an old proxy? mission_control.yml: hello)")
            return
        self._on_answer(answer)
        if answer.error:
            self._give_up(f"the proxy refused: {answer.reason} ({answer.error})")
            return
        self._ready()
        if rest:
            super().dataReceived(rest)

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802 - Twisted's name
        """Stop the heartbeat and report the loss."""
        self._is_ready = False
        if self._pulse is not None and self._pulse.active():
            self._pulse.cancel()
        super().connectionLost(reason)

    def close(self) -> None:
        """Send waiting data and close."""
        self._is_ready = False
        super().close()

    def _begin(self, link: GeneralMessageProtocol) -> None:
        if self._hello is None:
            self._ready()
            return
        self._pulse = self._clock.callLater(ANSWER_LIMIT_S, self._no_answer)
        super().send(hello_line(*self._hello))

    def _no_answer(self) -> None:
        self._give_up(f"no answer to the hello within {ANSWER_LIMIT_S:g} s")

    def _give_up(self, why: str) -> None:
        self._why_given_up = why
        self.abort()

    def _ready(self) -> None:
        if self._pulse is not None:
            self._pulse.cancel()
        self._is_ready = True
        self._sent_s = self._clock.seconds()
        if self._hello is not None:
            self._pulse = self._clock.callLater(HEARTBEAT_S, self._beat)
        self._on_ready(self)

    def _beat(self) -> None:
        silence_s = self._clock.seconds() - self._sent_s
        if silence_s >= HEARTBEAT_S:
            self.send(b"\n")
            silence_s = 0.0
        self._pulse = self._clock.callLater(HEARTBEAT_S - silence_s, self._beat)
