"""Drops the data that a link cannot take."""

from __future__ import annotations

from typing import Any

from twisted.internet.interfaces import IPushProducer
from zope.interface import implementer


@implementer(IPushProducer)
class Valve:
    """Writes to a TCP transport while it takes more; further data is dropped.

    Without this a peer that does not read would fill the memory. ``dropped`` counts.
    """

    def __init__(self, transport: Any) -> None:
        self._transport = transport
        self._is_open = True
        self.dropped = 0
        transport.setTcpNoDelay(True)
        transport.registerProducer(self, True)

    def write(self, data: bytes) -> None:
        """Write unless the transport is full."""
        if self._is_open:
            self._transport.write(data)
        else:
            self.dropped += 1

    def pauseProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Close."""
        self._is_open = False

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Open."""
        self._is_open = True

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Close permanently."""
        self._is_open = False
