"""The control lease of a link: one connection owns it while it is alive.

The proxy has two leases for each aircraft, its airborne connection and the ground in control; the
aircraft's own listener has one.
"""

import hmac
from enum import Enum
from typing import Generic, Protocol, TypeVar

ALIVE_S = 3.0
"""An owner that is silent for longer may lose the lease to a newcomer."""


class LeaseOwner(Protocol):
    """What a lease needs from a connection."""

    @property
    def last_rx_s(self) -> float:
        """Monotonic time of its last byte."""


class State(Enum):
    """The states of a lease."""

    # Enum's own hash is Python code, and a relay asks thousands of leases four times a second.
    __hash__ = object.__hash__

    FREE = "free"
    OWNED = "owned"
    SILENT = "silent"
    """The owner may lose the lease to a newcomer."""
    RESERVED = "reserved"
    """The owner has disconnected; its token resumes the lease."""


class Input(Enum):
    """The inputs of a lease; `TIMEOUT`: ALIVE_S after the owner's last byte."""

    __hash__ = object.__hash__

    ACQUIRE = "acquire"
    DISCONNECT = "disconnect"
    RELEASE = "release"
    TIMEOUT = "timeout"
    RECEIVE = "receive"


TRANSITIONS = {
    (State.FREE, Input.ACQUIRE): State.OWNED,
    (State.FREE, Input.RELEASE): State.FREE,
    (State.OWNED, Input.ACQUIRE): State.OWNED,
    (State.OWNED, Input.DISCONNECT): State.RESERVED,
    (State.OWNED, Input.RELEASE): State.FREE,
    (State.OWNED, Input.TIMEOUT): State.SILENT,
    (State.SILENT, Input.ACQUIRE): State.OWNED,
    (State.SILENT, Input.DISCONNECT): State.RESERVED,
    (State.SILENT, Input.RELEASE): State.FREE,
    (State.SILENT, Input.RECEIVE): State.OWNED,
    (State.RESERVED, Input.ACQUIRE): State.OWNED,
    (State.RESERVED, Input.RELEASE): State.FREE,
    (State.RESERVED, Input.TIMEOUT): State.FREE,
}
"""An input that a state does not list changes nothing."""

T = TypeVar("T", bound=LeaseOwner)


class ControlLease(Generic[T]):
    """The owner of the lease, and the token that resumes it. Times are monotonic.

    Receiving costs the owner nothing: TIMEOUT and RECEIVE are derived from its `last_rx_s` when the
    state is read. Whether a newcomer may acquire is the caller's decision by `is_free` and
    `is_resumed_by`.
    """

    __slots__ = ("_last_rx_s", "_state", "alive_s", "owner", "token")

    def __init__(self) -> None:
        self.owner: T | None = None
        """The connection that has the lease, alive or silent."""
        self.token: str | None = None
        self.alive_s = ALIVE_S
        """How long its owner may be silent."""
        self._state = State.FREE
        self._last_rx_s = 0.0

    def state(self, now_s: float) -> State:
        last_rx_s = self._last_rx_s if self.owner is None else self.owner.last_rx_s
        self._feed(Input.TIMEOUT if now_s - last_rx_s > self.alive_s else Input.RECEIVE)
        return self._state

    def is_free(self, now_s: float) -> bool:
        return self.state(now_s) in (State.FREE, State.SILENT)

    def is_resumed_by(self, token: str | None) -> bool:
        """Return whether this token acquires the lease immediately."""
        if token is None or self.token is None:
            return False
        return hmac.compare_digest(token, self.token)

    def live_owner(self, now_s: float) -> T | None:
        return self.owner if self.state(now_s) is State.OWNED else None

    def acquire(self, owner: T, token: str | None) -> T | None:
        """Set the owner and return the one that it replaces.

        `token` None: the lease cannot be resumed (a legacy client).
        """
        displaced, self.owner, self.token = self.owner, owner, token
        self._feed(Input.ACQUIRE)
        return None if displaced is owner else displaced

    def reserve(self, token: str, now_s: float) -> None:
        """Reserve a free lease for a token, as if its owner had just disconnected."""
        self._feed(Input.ACQUIRE)
        self.owner, self.token, self._last_rx_s = None, token, now_s
        self._feed(Input.DISCONNECT)

    def disconnect(self) -> None:
        """Remove the owner; its token resumes the lease until ALIVE_S after its last byte.

        Without a token it is free immediately.
        """
        if self.token is None:
            self.release()
        elif self.owner is not None:
            self._last_rx_s = self.owner.last_rx_s
            self.owner = None
            self._feed(Input.DISCONNECT)

    def release(self) -> None:
        """Free the lease immediately; its token becomes invalid."""
        self.owner = self.token = None
        self._feed(Input.RELEASE)

    def _feed(self, input_: Input) -> None:
        self._state = TRANSITIONS.get((self._state, input_), self._state)
