"""Waiting for the seat that commands."""

from __future__ import annotations

from enum import Enum

from up_ground.link_status import LinkStatus
from up_ground.settings import Seat

ASK_INTERVAL_S = 1.1
"""The proxy passes one request a second on."""
KEPT_S = 4.0
"""Longer than a proxy reserves the seat of a ground that has disconnected (3 s)."""


class Standing(Enum):
    """State of the seat as seen by this ground."""

    UNKNOWN = "unknown"
    OURS = "ours"
    FREE = "free"
    HELD = "held"
    LATER = "later"


def standing(status: LinkStatus, is_direct: bool) -> Standing:
    """Return who owns the seat; a direct link has no seats, so every peer may send there.

    FREE: the proxy reports no owner; it may still reserve the seat for a token.
    """
    if not status.is_open:
        return Standing.UNKNOWN
    if is_direct or status.seat is Seat.COMMAND:
        return Standing.OURS
    if not status.is_holder_known:
        return Standing.LATER
    return Standing.FREE if status.holder is None else Standing.HELD
