"""Matches requests to the Arduino with their answers."""

from collections.abc import Callable
from dataclasses import field

from twisted.internet.defer import Deferred

from up.commands.refusal import Code, CommandRefusedError
from up.quick_dataclass import dataclass
from up.system.clock import Clock, Timer, cancel

TIMEOUT_S = 0.5

Send = Callable[[str, bytes], "int | None"]


@dataclass(eq=False, slots=True)
class _Request:
    type: str
    payload: bytes
    answer_type: str
    may_repeat: bool
    done: Deferred[bytes]
    sequences: set[int] = field(default_factory=set)
    timer: Timer | None = None


class RequestTracker:
    """Matches answers to requests by type and frame sequence; the result is the answer's payload.

    A request without an answer within 500 ms is repeated once if that is harmless, then it fails.
    ``send`` returns the frame's sequence, or None if it was not sent. Failures are
    CommandRefusedError with a text for the sender.
    """

    def __init__(self, clock: Clock, send: Send) -> None:
        self.unmatched = 0
        self._clock = clock
        self._send = send
        self._waiting: list[_Request] = []

    def request(
        self, type_: str, payload: bytes = b"", *, answer: str = "K", may_repeat: bool = True
    ) -> Deferred[bytes]:
        """Send a request; ``answer`` is the type of its answer, `K` or a dedicated type."""
        request = _Request(type_, payload, answer, may_repeat, Deferred(self._cancelled))
        self._waiting.append(request)
        self._transmit(request)
        return request.done

    def on_confirmed(self, type_: str, sequence: int) -> None:
        """Process `K`."""
        request = self._find(type_, sequence)
        if request is not None and request.answer_type == "K":
            self._finish(request).callback(b"")
        else:
            self.unmatched += 1

    def on_refused(self, type_: str, sequence: int | None, reason: str, detail: str = "") -> bool:
        """Process `!`; return whether it belongs to a request. A sequence of None matches any."""
        request = self._find(type_, sequence)
        if request is None:
            return False
        self._finish(request).errback(
            CommandRefusedError(f"the Arduino refused: {reason}", detail=detail)
        )
        return True

    def on_value(self, type_: str, payload: bytes) -> None:
        """Process an answer with a value; it completes the oldest request for it."""
        for request in self._waiting:
            if request.answer_type == type_:
                self._finish(request).callback(payload)
                return
        self.unmatched += 1

    def fail_all(self, reason: str) -> None:
        """Fail all pending requests: the Arduino is gone."""
        for request in list(self._waiting):
            self._finish(request).errback(CommandRefusedError(reason, Code.UNAVAILABLE))

    def _transmit(self, request: _Request) -> None:
        sequence = self._send(request.type, request.payload)
        if sequence is None:
            self._finish(request).errback(
                CommandRefusedError(
                    "the line to the Arduino is closed", Code.UNAVAILABLE, detail="line_closed"
                )
            )
            return
        request.sequences.add(sequence)
        request.timer = self._clock.callLater(TIMEOUT_S, self._timed_out, request)

    def _timed_out(self, request: _Request) -> None:
        request.timer = None
        if request.may_repeat:
            request.may_repeat = False
            self._transmit(request)
            return
        self._finish(request).errback(
            CommandRefusedError("the Arduino did not answer", Code.TIMEOUT, detail="no_answer")
        )

    def _find(self, type_: str, sequence: int | None) -> _Request | None:
        for request in self._waiting:
            if request.type == type_ and (sequence is None or sequence in request.sequences):
                return request
        return None

    def _finish(self, request: _Request) -> Deferred[bytes]:
        self._waiting.remove(request)
        cancel(request.timer)
        return request.done

    def _cancelled(self, done: Deferred[bytes]) -> None:
        """Remove a request that its caller cancelled, so that it is not repeated."""
        for request in self._waiting:
            if request.done is done:
                self._finish(request)
                return
