"""A value stored on the Arduino, its gains or its profile: read, sent, read back."""

from collections.abc import Callable
from typing import Any, Generic, Protocol, TypeVar

from twisted.internet.defer import Deferred

from up.commands.refusal import CommandRefusedError

T = TypeVar("T")


class Board(Protocol):
    """The operations on the link to the Arduino."""

    def request(self, type_: str, payload: bytes = b"", *, answer: str = "K") -> Deferred[bytes]:
        """Send a request to the Arduino; raises or fails with CommandRefusedError."""

    def send_unanswered(self, type_: str, payload: bytes) -> None:
        """Send a message that an old firmware does not confirm; raises CommandRefusedError."""


class MirroredParameter(Generic[T]):
    """Reads a value by the request ``ask``, answered by ``answer``, and sends new values.

    ``current`` is the board's last reported value, None while unknown. ``decode`` raises ValueError
    for invalid bytes; ``what`` names the value in messages. Failures are CommandRefusedError with a
    text for the sender. ``on_changed`` is called for the board's first value and for every
    different one.
    """

    def __init__(
        self,
        board: Board,
        ask: str,
        answer: str,
        decode: Callable[[bytes], T],
        what: str,
        on_changed: Callable[[T], object],
    ) -> None:
        self.current: T | None = None
        self.is_setting = False
        self._board = board
        self._ask = ask
        self._answer = answer
        self._decode = decode
        self._what = what
        self._on_changed = on_changed
        self._reported: T | None = None

    def read(self) -> Deferred[T]:
        """Request the value; the result is the board's current value."""
        return self._board.request(self._ask, answer=self._answer).addCallback(self._on_read)

    def send(
        self, type_: str, payload: bytes, matches: Callable[[T], bool], *, is_answered: bool = True
    ) -> Deferred[Any]:
        """Send a value; the result fires when the board has confirmed it.

        The value is read back: ``matches`` compares it with the one sent. An old firmware confirms
        in no other way (``is_answered`` false). One at a time: see ``is_setting``.
        """
        done: Deferred[Any]
        if is_answered:
            done = self._board.request(type_, payload).addCallback(lambda _: self.read())
        else:
            self._board.send_unanswered(type_, payload)
            done = self.read()
        self.is_setting = True
        return done.addCallback(self._compare, matches).addBoth(self._settled)

    def _on_read(self, payload: bytes) -> T:
        try:
            self.current = self._decode(payload)
        except ValueError as error:
            raise CommandRefusedError(
                f"the Arduino's {self._what} is invalid: {error}", detail="invalid_value"
            ) from None
        if self.current != self._reported:
            self._reported = self.current
            self._on_changed(self.current)
        return self.current

    def _compare(self, current: T, matches: Callable[[T], bool]) -> None:
        if not matches(current):
            raise CommandRefusedError(
                f"the Arduino has another {self._what} than it was sent", detail="value_differs"
            )

    def _settled(self, outcome: Any) -> Any:
        self.is_setting = False
        return outcome
