"""The seat of a link, with the interface that `Control` requires."""

from __future__ import annotations

from up_ground.ground_link import GroundLink
from up_ground.link_status import Standing, standing
from up_ground.settings import Seat

HELLO_AFTER = 5
"""Requests between two hellos to an aircraft's own listener, which does not report the owner."""


class SeatAtProxy:
    """The seat that a link to a proxy has or has not; a direct link always has one."""

    def __init__(self, link: GroundLink, is_direct: bool) -> None:
        self._link = link
        self._is_direct = is_direct
        self._unheard = 0
        self._is_left = False

    @property
    def standing(self) -> Standing:
        """Return the owner; a released seat is not ours, even before the proxy confirms it."""
        now = standing(self._link.status, self._is_direct)
        if now is not Standing.OURS:
            self._is_left = False
        return Standing.LATER if self._is_left else now

    @property
    def holder(self) -> int | None:
        """Return the number of the ground that has it."""
        return self._link.status.holder

    def take_ask(self) -> int | None:
        """Return which ground has requested it since the last call."""
        status = self._link.status
        asked, status.asked_by = status.asked_by, None
        return asked

    def request(self) -> None:
        """Request it; a peer without that request gets a new hello instead."""
        if self.standing is not Standing.LATER:
            self._unheard = 0
        elif self._unheard % HELLO_AFTER == 1:
            self._unheard += 1
            self._link.reconnect(Seat.COMMAND)
            return
        else:
            self._unheard += 1
        self._link.request_seat()

    def give(self, to: int) -> None:
        """Hand it to another ground; it stays ours if that one has disconnected."""
        self._link.give_seat(to)

    def release(self) -> None:
        """Leave it free."""
        self._unheard = 0
        self._is_left = not self._is_direct
        status = self._link.status
        if status.seat is Seat.COMMAND and not status.is_holder_known and not self._is_direct:
            self._link.reconnect(Seat.LISTEN)
        else:
            self._link.release_seat()
