"""The send buffer of a page: messages in order, of each kind of news only the newest."""

from __future__ import annotations

from collections.abc import Callable

from up.protocols.link_output import BaseOutput, Make

PENDING_LIMIT = 1 << 20
"""Bytes in order that wait for a page that does not read; more, and it is given up."""


class PageOutput(BaseOutput):
    """The send buffer of a WebSocket.

    A frame or a status is encoded when it is sent, not when it arrives, so that its age is right.
    ``on_overrun`` is called when ``PENDING_LIMIT`` is exceeded; after that nothing is sent.
    """

    def __init__(self, on_overrun: Callable[[], object]) -> None:
        super().__init__()
        self._on_overrun = on_overrun

    @property
    def waiting_bytes(self) -> int:
        """Return the size of the queued messages."""
        return self._size

    def send(self, message: bytes) -> None:
        """Send ``message`` after those before it."""
        if self._transport is None:
            return
        self._put(message)
        if self._size > PENDING_LIMIT:
            self.stopProducing()
            self._on_overrun()

    def send_newest(self, kind: str, make: Make) -> None:
        """Send the result of ``make`` in place of a queued one of this kind."""
        if self._transport is not None:
            self._put_news(kind, make, may_leave=self._is_drained)

    def forget(self, kind: str) -> None:
        """Drop the queued one of a kind."""
        self._news.pop(kind, None)
