"""State of the link to the aircraft, and of control over it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from up_ground.settings import Seat


class LinkState(Enum):
    """State of the connection to the proxy."""

    CONNECTING = "connecting"
    OPEN = "connected"
    WAITING = "waiting"
    STOPPED = "stopped"


@dataclass(slots=True)
class LinkStatus:
    """The present state of the link; times are in seconds of the clock.

    ``seat`` and ``is_aircraft_online`` stay None while unknown: before the answer to the hello,
    and always on a direct link. ``holder`` is the number of the ground that commands.
    """

    state: LinkState = LinkState.CONNECTING
    since_s: float = 0.0
    reason: str = ""
    """Why the link is down, one sentence."""
    code: str = ""
    """The code of ``reason``: unreachable, no_proxy, no_hello_answer, rejected, lost, ..."""
    rejection: str = ""
    """The code with which the proxy refused the hello."""
    seat: Seat | None = None
    holder: int | None = None
    is_holder_known: bool = False
    asked_by: int | None = None
    """The listener that requests the seat held here."""
    is_aircraft_online: bool | None = None
    tls_peer: str | None = None
    """The name in the peer's certificate; None: the link is plain."""
    round_trip_ms: float | None = None
    """The kernel's measure of the way to the proxy and back."""
    failures: int = 0
    """Attempts that failed since the last good connection."""
    connections: int = 0
    malformed: int = 0
    """Lines that were no General Messages."""
    too_long: int = 0
    keyless: int = 0
    """Packed frames whose key was not received here."""
    strange_control: int = 0
    """Unknown control lines."""
    is_keyed: bool = False
    """Whether this device has a key for the aircraft, so that plain lines are refused."""
    key_name: str = ""
    key_role: str = ""
    """The role of the key in the open session; empty without a session."""
    is_secret: bool = False
    """Whether the open session is encrypted, so that no relay reads it."""
    key_refusal: str = ""
    """The code with which the aircraft refused the key."""
    refused: int = 0
    """Lines that the key does not authenticate, or that came before."""
    unprotected: int = 0
    """Plain lines on a link with a key, or protected ones without a key."""
    clock: tuple[float, float, float] | None = None
    """The aircraft's clock, ms, authenticated by the key; it was read between two times here."""

    @property
    def is_open(self) -> bool:
        return self.state is LinkState.OPEN

    @property
    def dropped(self) -> int:
        counted = self.malformed + self.too_long + self.keyless + self.strange_control
        return counted + self.refused

    @property
    def key_fault(self) -> tuple[str, str] | None:
        """Return why nothing of the aircraft is readable, a sentence and its code."""
        if self.key_refusal == "secrecy_required":
            text = "the aircraft requires secrecy, and the Python package cryptography is missing"
            return text, self.key_refusal
        if self.key_refusal:
            return f"the aircraft refuses this device's key: {self.key_refusal}", self.key_refusal
        if self.is_keyed and not self.key_role:
            return "no protected session: the aircraft does not answer this key", "no_session"
        if self.unprotected and not self.is_keyed:
            return "the aircraft requires a key: run 'up-ground pair'", "key_missing"
        return None

    @property
    def security(self) -> str:
        """Return plain, end_to_end, or, with a key and no session yet, none."""
        if not self.is_keyed:
            return "plain"
        return "end_to_end" if self.key_role else "none"

    def disconnected(
        self, state: LinkState, now_s: float, reason: str = "", code: str = ""
    ) -> None:
        """Reset the fields that only a connection can fill."""
        self.state = state
        self.since_s = now_s
        self.reason = reason
        self.code = code
        self.seat = self.holder = self.asked_by = self.is_aircraft_online = None
        self.is_holder_known = False
        self.round_trip_ms = self.tls_peer = None


ASK_INTERVAL_S = 1.1
"""The proxy passes one request a second on."""
KEPT_S = 4.0
"""Longer than a proxy reserves the seat of a ground that has disconnected (3 s)."""


class ControlStatus(Enum):
    """State of the seat as seen by this ground."""

    UNKNOWN = "unknown"
    OURS = "ours"
    FREE = "free"
    HELD = "held"
    LATER = "later"


def control_status(status: LinkStatus, is_direct: bool) -> ControlStatus:
    """Return who owns the seat; a direct link has no seats, so every peer may send there.

    FREE: the proxy reports no owner; it may still reserve the seat for a token.
    """
    if not status.is_open:
        return ControlStatus.UNKNOWN
    if is_direct or status.seat is Seat.COMMAND:
        return ControlStatus.OURS
    if not status.is_holder_known:
        return ControlStatus.LATER
    return ControlStatus.FREE if status.holder is None else ControlStatus.HELD
