"""What waits to leave on a link: messages in order, telemetry only the newest."""

from __future__ import annotations

from typing import Any

from twisted.internet.interfaces import IPullProducer
from zope.interface import implementer

from up.protocols.tcp_options import is_stalled

PENDING_LIMIT = 65536


@implementer(IPullProducer)
class LinkOutput:
    """Hands a transport the next bytes only after it has sent the ones before.

    The transport asks for more each time that its buffer is empty, so whatever is newer can still
    take the place of what waits here. `dropped` counts messages beyond `PENDING_LIMIT` bytes,
    `replaced` telemetry that a newer one made old.
    """

    def __init__(self) -> None:
        self.dropped = 0
        self.replaced = 0
        self._transport: Any = None
        self._is_drained = False
        self._messages: list[bytes] = []
        self._messages_size = 0
        self._newest: bytes | None = None

    def start(self, transport: Any) -> None:
        """Begin to send on `transport`."""
        self._transport = transport
        transport.registerProducer(self, False)

    def finish(self) -> None:
        """Hand over all that waits, so that the transport can close when it is sent."""
        if self._transport is not None:
            self.resumeProducing()
            self._transport.unregisterProducer()
            self._transport = None

    def send(self, message: bytes) -> bool:
        """Send `message` after those before it; False: dropped."""
        if self._transport is None or self._messages_size + len(message) > PENDING_LIMIT:
            self.dropped += 1
            return False
        if self._is_drained:
            self._is_drained = False
            self._transport.write(message)
        else:
            self._messages.append(message)
            self._messages_size += len(message)
        return True

    def send_newest(self, message: bytes) -> bool:
        """Send `message` in place of one that still waits; False: there is no link.

        While the peer acknowledges nothing it waits for the next one, which replaces it: TCP
        would deliver all that it was given, late and in order.
        """
        if self._transport is None:
            return False
        if self._newest is not None:
            self.replaced += 1
        if self._is_drained and not is_stalled(self._transport):
            self._is_drained = False
            self._newest = None
            self._transport.write(message)
        else:
            self._newest = message
        return True

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Send what waits: the transport has sent everything else."""
        waiting = self._messages
        if self._newest is not None:
            waiting.append(self._newest)
            self._newest = None
        self._is_drained = not waiting
        if waiting:
            self._messages = []
            self._messages_size = 0
            self._transport.write(b"".join(waiting))

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Forget what waits: the connection is gone."""
        self._transport = None
        self._messages.clear()
        self._messages_size = 0
        self._newest = None
