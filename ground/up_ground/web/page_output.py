"""What waits to leave for a page: messages in order, of each kind of news only the newest."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.internet.interfaces import IPullProducer
from zope.interface import implementer

PENDING_LIMIT = 1 << 20
"""Bytes in order that wait for a page that does not read; more, and it is given up."""

Make = Callable[[], bytes]


@implementer(IPullProducer)
class PageOutput:
    """Hands a transport the next bytes only after it has sent the ones before.

    News (a frame, a status) is put into bytes when it leaves, not when it comes, so that the age
    in it is true, and of one kind never more than one waits. ``replaced`` counts what a newer one
    made old. ``on_overrun`` hears that ``PENDING_LIMIT`` is passed; nothing is sent from then on.
    """

    def __init__(self, on_overrun: Callable[[], object]) -> None:
        self.replaced = 0
        self._on_overrun = on_overrun
        self._transport: Any = None
        self._is_drained = False
        self._messages: list[bytes] = []
        self._size = 0
        self._news: dict[str, Make] = {}

    @property
    def waiting_bytes(self) -> int:
        """Return the size of what waits in order."""
        return self._size

    def start(self, transport: Any) -> None:
        """Begin to send on ``transport``."""
        self._transport = transport
        transport.registerProducer(self, False)

    def finish(self) -> None:
        """Hand over all that waits, so that the transport can close when it is sent."""
        if self._transport is not None:
            self.resumeProducing()
            self._transport.unregisterProducer()
            self._transport = None

    def send(self, message: bytes) -> None:
        """Send ``message`` after those before it."""
        if self._transport is None:
            return
        if self._is_drained:
            self._is_drained = False
            self._transport.write(message)
            return
        self._messages.append(message)
        self._size += len(message)
        if self._size > PENDING_LIMIT:
            self.stopProducing()
            self._on_overrun()

    def send_newest(self, kind: str, make: Make) -> None:
        """Send what ``make`` returns in place of one of this kind that still waits."""
        if self._transport is None:
            return
        if self._is_drained:
            self._is_drained = False
            self._transport.write(make())
            return
        if kind in self._news:
            self.replaced += 1
        self._news[kind] = make

    def forget(self, kind: str) -> None:
        """Drop what waits of a kind."""
        self._news.pop(kind, None)

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Send what waits: the transport has sent everything else."""
        waiting, self._messages, self._size = self._messages, [], 0
        news, self._news = self._news, {}
        waiting.extend(make() for make in news.values())
        self._is_drained = not waiting
        if waiting:
            self._transport.write(b"".join(waiting))

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Forget what waits: the connection is gone."""
        self._transport = None
        self._messages.clear()
        self._size = 0
        self._news.clear()
