"""The send queue of a link: messages in order, of replaceable kinds only the newest."""

from collections.abc import Callable
from typing import Any

from twisted.internet.interfaces import IPullProducer
from zope.interface import implementer

from up.protocols.tcp_options import is_stalled

PENDING_LIMIT = 65536

Make = Callable[[], bytes]


@implementer(IPullProducer)
class BaseOutput:
    """Hands a transport the next bytes only after it has sent the previous ones.

    The transport asks for more each time its buffer is empty, so that newer data can still replace
    waiting data. `replaced` counts replaced messages.
    """

    def __init__(self) -> None:
        self.replaced = 0
        self._transport: Any = None
        self._is_drained = False
        self._messages: list[bytes] = []
        self._size = 0
        self._news: dict[str, Make] = {}

    def start(self, transport: Any) -> None:
        self._transport = transport
        transport.registerProducer(self, False)

    def finish(self) -> None:
        """Hand over all waiting data, so that the transport can close after sending it."""
        if self._transport is not None:
            self.resumeProducing()
            self._transport.unregisterProducer()
            self._transport = None

    def _put(self, message: bytes) -> None:
        """Send `message` after those before it."""
        if self._is_drained:
            self._is_drained = False
            self._transport.write(message)
        else:
            self._messages.append(message)
            self._size += len(message)

    def _put_news(self, kind: str, make: Make, *, may_leave: bool) -> None:
        """Send the result of `make`, replacing a waiting message of this kind."""
        if kind in self._news:
            self.replaced += 1
        if may_leave:
            self._is_drained = False
            self._news.pop(kind, None)
            self._transport.write(make())
        else:
            self._news[kind] = make

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        waiting, self._messages, self._size = self._messages, [], 0
        news, self._news = self._news, {}
        waiting.extend(make() for make in news.values())
        self._is_drained = not waiting
        if waiting:
            self._transport.write(b"".join(waiting))

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        self._transport = None
        self._messages.clear()
        self._size = 0
        self._news.clear()


class LinkOutput(BaseOutput):
    """Only telemetry is replaceable; `dropped` counts messages beyond `PENDING_LIMIT` bytes."""

    def __init__(self) -> None:
        super().__init__()
        self.dropped = 0

    def send(self, message: bytes) -> bool:
        """Send `message` after those before it; False if dropped."""
        if self._transport is None or self._size + len(message) > PENDING_LIMIT:
            self.dropped += 1
            return False
        self._put(message)
        return True

    def send_newest(self, message: bytes | Make) -> bool:
        """Send `message` in place of one that still waits; False without a link.

        A function makes the message when it leaves, or is never called. While the peer acknowledges
        nothing, a message waits until the next one replaces it: TCP would deliver everything it was
        given, late and in order.
        """
        if self._transport is None:
            return False
        may_leave = self._is_drained and not is_stalled(self._transport)
        make = message if callable(message) else lambda: message
        self._put_news("", make, may_leave=may_leave)
        return True
