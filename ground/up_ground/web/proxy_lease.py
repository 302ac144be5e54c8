"""The seat of a link, with the interface that `Control` requires."""

from __future__ import annotations

from up_ground.ground_link import GroundLink
from up_ground.link_status import ControlStatus, control_status
from up_ground.settings import Seat

HELLO_AFTER = 5
"""Requests between two hellos to an aircraft's own listener, which does not report the owner."""


class ProxyLease:
    """The seat that a link to a proxy has or has not; a direct link always has one."""

    def __init__(self, link: GroundLink, is_direct: bool) -> None:
        self._link = link
        self._is_direct = is_direct
        self._unanswered = 0
        self._is_left = False

    @property
    def status(self) -> ControlStatus:
        """Return the owner; a released seat is not ours, even before the proxy confirms it."""
        now = control_status(self._link.status, self._is_direct)
        if now is not ControlStatus.OURS:
            self._is_left = False
        return ControlStatus.LATER if self._is_left else now

    @property
    def holder(self) -> int | None:
        return self._link.status.holder

    def pop_request(self) -> int | None:
        """Return which ground has requested it since the last call."""
        link = self._link.status
        asked, link.asked_by = link.asked_by, None
        return asked

    def request(self) -> None:
        """Request it; a peer without that request gets a new hello instead."""
        if self.status is not ControlStatus.LATER:
            self._unanswered = 0
        elif self._unanswered % HELLO_AFTER == 1:
            self._unanswered += 1
            self._link.reconnect(Seat.COMMAND)
            return
        else:
            self._unanswered += 1
        self._link.request_seat()

    def give(self, to: int) -> None:
        """Hand it to another ground; it stays ours if that one has disconnected."""
        self._link.give_seat(to)

    def release(self) -> None:
        self._unanswered = 0
        self._is_left = not self._is_direct
        status = self._link.status
        if status.seat is Seat.COMMAND and not status.is_holder_known and not self._is_direct:
            self._link.reconnect(Seat.LISTEN)
        else:
            self._link.release_seat()
