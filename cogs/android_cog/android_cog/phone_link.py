"""The phone's General Messages, over TCP or UDP, from one phone at a time."""

import re
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.interfaces import IAddress
from twisted.internet.protocol import Factory, Protocol

from up.commands.refusal import Code
from up.protocols.general_message import GeneralMessage, MalformedMessage, decode, encode
from up.protocols.general_message_link import (
    MAX_BURST,
    MAX_MESSAGES_HZ,
    GeneralMessageLink,
    GeneralMessageProtocol,
)
from up.protocols.general_message_udp import SILENCE_TIMEOUT_S, GeneralMessageDatagrams
from up.protocols.line_decoder import MAX_LINE_BYTES
from up.system.clock import Clock, Timer, cancel
from up.system.peer_filter import PeerFilter
from up.system.token_bucket import TokenBucket

MAX_UNDECIDED = 8
"""Connections whose phone is not identified yet."""
MAX_UNDECIDED_LINE = 1024
"""Bytes of the first line of such a connection: an unknown peer must cost almost nothing."""
_FOREIGN_HZ = 10.0
_IDENTITY = re.compile(r"([0-9a-f]{1,8})\.[0-9]+", re.ASCII)

OnMessage = Callable[[GeneralMessageLink, GeneralMessage], object]
OnMalformed = Callable[[GeneralMessageLink, MalformedMessage], object]
OnLink = Callable[[GeneralMessageLink], object]
OnLost = Callable[[GeneralMessageLink, str], object]


class PhoneLink:
    """One phone owns the link until its connection closes or it is silent for 1.5 s.

    A phone is identified by the part before the dot of the id of its first message
    (docs/protocols.md 4); one without such an id by its host, on UDP by host and port. The same
    phone replaces its own connection immediately. Another phone gets the nack `taken` and is
    closed, after its first message or 1.5 s; `on_rejected` gets its address, `rejected` counts.

    The other callbacks get the connection, or the datagram protocol, of the event.
    """

    def __init__(
        self,
        clock: Clock,
        peers: PeerFilter,
        *,
        on_message: OnMessage,
        on_malformed: OnMalformed,
        on_connected: OnLink,
        on_lost: OnLost,
        on_rejected: Callable[[str], object],
    ) -> None:
        self._clock = clock
        self.bucket = TokenBucket(clock, MAX_MESSAGES_HZ, MAX_BURST)
        self._foreign = TokenBucket(clock, _FOREIGN_HZ, _FOREIGN_HZ)
        self._callbacks: dict[str, Any] = {
            "on_message": self._message,
            "on_malformed": self._malformed,
            "on_connected": self._connected,
            "on_lost": self._lost,
        }
        self._on_message = on_message
        self._on_malformed = on_malformed
        self._on_connected = on_connected
        self._on_lost = on_lost
        self._on_rejected = on_rejected
        self._owner: GeneralMessageLink | None = None
        self._identity = ""
        self._address = ""
        self._undecided: dict[GeneralMessageProtocol, Timer] = {}
        self._open: set[GeneralMessageProtocol] = set()
        self._all_closed: Deferred[None] | None = None
        self.peers = peers
        self.rejected = 0
        self.replaced = 0
        self.dropped_too_long = 0
        self.factory = _Streams(self)
        self.datagrams = _FilteredDatagrams(clock, self, {**self._callbacks, "bucket": self.bucket})

    @property
    def current(self) -> GeneralMessageLink | None:
        """Return the link to the phone, or None while it is absent."""
        return self._owner

    @property
    def host(self) -> str:
        """Return the phone's host; empty while it is absent."""
        return "" if self._owner is None else host_of(self._owner.peer)

    def send_by_stream(self, message: bytes) -> bool:
        """Send to the TCP connection in order; False if dropped."""
        return self._owner is not self.datagrams and self.send(message)

    def send(self, message: bytes) -> bool:
        """Send in order over the phone's current link; False if dropped."""
        return self._owner is not None and self._owner.send(message)

    def send_newest(self, message: bytes) -> bool:
        """Send in place of an older waiting message."""
        return self._owner is not None and self._owner.send_newest(message)

    def build(self) -> GeneralMessageProtocol:
        return GeneralMessageProtocol(self._clock, **self._callbacks)

    async def close(self) -> None:
        """Drop the phone and wait until its connections are closed."""
        if self._open:
            self._all_closed = Deferred()
            for stream in list(self._open):
                stream.close()
            await self._all_closed

    def admits_datagram(self, datagram: bytes, addr: Any) -> bool:
        """Return whether a datagram from another address makes that address the owner."""
        address = f"{addr[0]}:{addr[1]}"
        if not self._may_own("", address):
            # A few are decoded, to recognize the owner's new address and to answer another phone.
            if not self._foreign.take():
                return False
            try:
                message = decode(datagram)
            except MalformedMessage:
                return False
            if not self._may_own(_identity_of(message), address):
                self._reject(address, message, lambda raw: self.datagrams.send_to(raw, addr))
                return False
        if self._owner is not None and self._owner is not self.datagrams:
            self._replace()
        return True

    def _may_own(self, identity: str, address: str) -> bool:
        if self._owner is None:
            return True
        if identity and self._identity:
            is_same = identity == self._identity
        else:
            is_same = not self._identity and address == self._address
        return is_same or self._clock.seconds() - self._owner.heard_s > SILENCE_TIMEOUT_S

    def _connected(self, link: GeneralMessageLink) -> None:
        if not isinstance(link, GeneralMessageProtocol):
            self._own(link, link.peer)
            return
        self._open.add(link)
        if self._may_own("", host_of(link.peer)):
            self._own(link, host_of(link.peer))
            return
        link.longest_line = MAX_UNDECIDED_LINE
        self._undecided[link] = self._clock.callLater(SILENCE_TIMEOUT_S, self._decide, link)
        if len(self._undecided) > MAX_UNDECIDED:
            self._decide(next(iter(self._undecided)))

    def _own(self, link: GeneralMessageLink, address: str, identity: str = "") -> None:
        self._replace()
        if isinstance(link, GeneralMessageProtocol):
            # A separate bucket until here, so that no other phone can empty the owner's.
            link.bucket = self.bucket
            link.longest_line = MAX_LINE_BYTES
        self._owner, self._address, self._identity = link, address, identity
        self._on_connected(link)

    def _replace(self) -> None:
        older, self._owner = self._owner, None
        if older is not None:
            self.replaced += 1
            self._on_lost(older, "replaced by a newer connection")
            older.close()

    def _decide(self, link: GeneralMessageProtocol, message: GeneralMessage | None = None) -> None:
        timer = self._undecided.pop(link)
        cancel(timer)
        address, identity = host_of(link.peer), _identity_of(message)
        if self._may_own(identity, address):
            self._own(link, address, identity)
        else:
            self._reject(link.peer, message, link.send)
            link.close()

    def _reject(
        self, peer: str, message: GeneralMessage | None, send: Callable[[bytes], object]
    ) -> None:
        self.rejected += 1
        if message is not None and message.id is not None and self._owner is not None:
            reason = f"another phone is connected, from {self._owner.peer}"
            data = {"id": message.id, "code": Code.TAKEN.value, "reason": reason}
            send(encode("up.nack", data))
        self._on_rejected(peer)

    def _message(self, link: GeneralMessageLink, message: GeneralMessage) -> None:
        if isinstance(link, GeneralMessageProtocol) and link in self._undecided:
            self._decide(link, message)
        if link is self._owner:
            self._identity = self._identity or _identity_of(message)
            self._on_message(link, message)

    def _malformed(self, link: GeneralMessageLink, fault: MalformedMessage) -> None:
        if isinstance(link, GeneralMessageProtocol) and link in self._undecided:
            self._decide(link)
        if link is self._owner:
            self._on_malformed(link, fault)

    def _lost(self, link: GeneralMessageLink, why: str) -> None:
        if isinstance(link, GeneralMessageProtocol):
            self._open.discard(link)
            self.dropped_too_long += link.dropped_too_long
            timer = self._undecided.pop(link, None)
            cancel(timer)
        if link is self._owner:
            self._owner = None
            self._on_lost(link, why)
        if not self._open and self._all_closed is not None:
            self._all_closed.callback(None)
            self._all_closed = None


class _Streams(Factory):
    """Builds a protocol for each connection of a permitted peer."""

    noisy = False

    def __init__(self, link: PhoneLink) -> None:
        self._link = link

    def buildProtocol(self, addr: IAddress | None) -> Protocol | None:  # noqa: N802 - Twisted's name
        return self._link.build() if self._link.peers.permits(getattr(addr, "host", "")) else None


class _FilteredDatagrams(GeneralMessageDatagrams):
    """Accepts permitted peers only, and of them the phone that owns the link."""

    noisy = False

    def __init__(self, clock: Clock, link: PhoneLink, callbacks: dict[str, Any]) -> None:
        super().__init__(clock, **callbacks)
        self._link = link

    def send_to(self, message: bytes, addr: Any) -> None:
        """Send one datagram to an address other than the peer's."""
        with suppress(OSError):
            self.transport.write(message, addr)

    def datagramReceived(self, datagram: bytes, addr: Any) -> None:  # noqa: N802 - Twisted's name
        if self._link.peers.permits(addr[0]):
            super().datagramReceived(datagram, addr)

    def _admits(self, datagram: bytes, addr: Any) -> bool:
        return self._link.admits_datagram(datagram, addr)


def host_of(peer: str) -> str:
    """Return the host in a peer's text of host and port."""
    return peer.rpartition(":")[0]


def _identity_of(message: GeneralMessage | None) -> str:
    """Return the phone that an id names; empty for the ids of legacy phones, which name none."""
    found = _IDENTITY.fullmatch(message.id or "") if message is not None else None
    return "" if found is None else found[1]
