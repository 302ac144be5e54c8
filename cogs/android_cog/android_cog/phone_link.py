"""The phone's General Messages, on TCP or on UDP."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.interfaces import IAddress
from twisted.internet.protocol import Factory, Protocol

from up.protocols.general_message import GeneralMessage, MalformedMessage
from up.protocols.general_message_link import GeneralMessageLink, GeneralMessageProtocol
from up.protocols.general_message_udp import GeneralMessageDatagrams
from up.system.clock import Clock
from up.system.plain_peers import PlainPeers

OnMessage = Callable[[GeneralMessageLink, GeneralMessage], object]
OnMalformed = Callable[[GeneralMessageLink, MalformedMessage], object]
OnLink = Callable[[GeneralMessageLink], object]
OnLost = Callable[[GeneralMessageLink, str], object]


class PhoneLink:
    """One phone: the newest TCP connection, and without one the UDP address heard last.

    A newer TCP connection replaces the older, which a phone that lost its network leaves behind.
    The callbacks get the connection or the datagrams that they concern.
    """

    def __init__(
        self,
        clock: Clock,
        peers: PlainPeers,
        *,
        on_message: OnMessage,
        on_malformed: OnMalformed,
        on_connected: OnLink,
        on_lost: OnLost,
    ) -> None:
        self._clock = clock
        self._callbacks: dict[str, Any] = {
            "on_message": on_message,
            "on_malformed": on_malformed,
            "on_connected": self._connected,
            "on_lost": self._lost,
        }
        self._on_connected = on_connected
        self._on_lost = on_lost
        self._stream: GeneralMessageProtocol | None = None
        self._open: set[GeneralMessageProtocol] = set()
        self._all_closed: Deferred[None] | None = None
        self.peers = peers
        self.replaced = 0
        self.dropped_too_long = 0
        self.factory = _Streams(self)
        self.datagrams = _JudgedDatagrams(clock, peers, self._callbacks)

    @property
    def current(self) -> GeneralMessageLink | None:
        """Return the link that the phone is reached by, None while it is away."""
        if self._stream is not None:
            return self._stream
        return self.datagrams if self.datagrams.peer else None

    def send_by_stream(self, message: bytes) -> bool:
        """Send to the TCP connection in order; False: dropped."""
        return self._stream is not None and self._stream.send(message)

    def send(self, message: bytes) -> bool:
        """Send in order to wherever the phone is; False: dropped."""
        link = self.current
        return link is not None and link.send(message)

    def send_newest(self, message: bytes) -> bool:
        """Send in place of an older message that still waits."""
        link = self.current
        return link is not None and link.send_newest(message)

    def is_stream(self, link: GeneralMessageLink) -> bool:
        """Return whether a link is a TCP connection."""
        return link is not self.datagrams

    def build(self) -> GeneralMessageProtocol:
        """Return the protocol of a new TCP connection."""
        return GeneralMessageProtocol(self._clock, **self._callbacks)

    async def close(self) -> None:
        """Give the phone up and wait until its connections are closed."""
        if self._open:
            self._all_closed = Deferred()
            for stream in list(self._open):
                stream.close()
            await self._all_closed

    def _connected(self, link: GeneralMessageLink) -> None:
        if isinstance(link, GeneralMessageProtocol):
            older, self._stream = self._stream, link
            self._open.add(link)
            if older is not None:
                self.replaced += 1
                self._on_lost(older, "replaced by a newer connection")
                older.close()
        self._on_connected(link)

    def _lost(self, link: GeneralMessageLink, why: str) -> None:
        if not isinstance(link, GeneralMessageProtocol):
            self._on_lost(link, why)
            return
        self._open.discard(link)
        self.dropped_too_long += link.dropped_too_long
        if link is self._stream:
            self._stream = None
            self._on_lost(link, why)
        if not self._open and self._all_closed is not None:
            self._all_closed.callback(None)
            self._all_closed = None


class _Streams(Factory):
    """Builds a protocol for each connection of a peer that may speak."""

    noisy = False

    def __init__(self, link: PhoneLink) -> None:
        self._link = link

    def buildProtocol(self, addr: IAddress | None) -> Protocol | None:  # noqa: N802 - Twisted's name
        return self._link.build() if self._link.peers.permits(getattr(addr, "host", "")) else None


class _JudgedDatagrams(GeneralMessageDatagrams):
    """Hears only peers that may speak."""

    noisy = False

    def __init__(self, clock: Clock, peers: PlainPeers, callbacks: dict[str, Any]) -> None:
        super().__init__(clock, **callbacks)
        self._peers = peers

    def datagramReceived(self, datagram: bytes, addr: Any) -> None:  # noqa: N802 - Twisted's name
        if self._peers.permits(addr[0]):
            super().datagramReceived(datagram, addr)
