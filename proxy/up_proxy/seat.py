"""A seat: one connection holds it, and no other can take it while that one is alive.

    free --take--> held --leave--> kept for its token --ALIVE_S--> free
                     |--ALIVE_S without a byte--> free to others, still the holder's until then
                     '--release--> free

The aircraft's own place is such a seat, and so is the control of its grounds.
"""

import hmac
from typing import Generic, Protocol, TypeVar

ALIVE_S = 3.0
"""A holder that is silent for longer may lose its seat to a newcomer."""


class Occupant(Protocol):
    """The attributes of the connection that holds a seat."""

    heard_s: float
    """Monotonic time of its last byte."""


T = TypeVar("T", bound=Occupant)


class Seat(Generic[T]):
    """The holder of the seat, and the token that takes it over immediately. Times are monotonic."""

    __slots__ = ("_left_s", "occupant", "token")

    def __init__(self) -> None:
        self.occupant: T | None = None
        self.token: str | None = None
        self._left_s = 0.0

    def is_free(self, now_s: float) -> bool:
        """Return whether a newcomer may take the seat."""
        if self.occupant is not None:
            return now_s - self.occupant.heard_s > ALIVE_S
        return self.token is None or now_s - self._left_s > ALIVE_S

    def is_resumed_by(self, token: str | None) -> bool:
        """Return whether this token takes the seat over immediately."""
        if token is None or self.token is None:
            return False
        return hmac.compare_digest(token, self.token)

    def holder(self, now_s: float) -> T | None:
        """Return the occupant while it is alive."""
        return None if self.is_free(now_s) else self.occupant

    def take(self, occupant: T, token: str | None) -> T | None:
        """Seat a new occupant and return the one that it replaced.

        `token` None: the seat cannot be resumed (a thesis client).
        """
        displaced = self.occupant
        self.occupant = occupant
        self.token = token
        return displaced

    def leave(self) -> None:
        """Remove the occupant; the seat is kept for its token until ALIVE_S after its last byte."""
        if self.occupant is not None:
            self._left_s = self.occupant.heard_s
            self.occupant = None

    def release(self) -> None:
        """Free the seat immediately; its token becomes invalid."""
        self.occupant = None
        self.token = None
