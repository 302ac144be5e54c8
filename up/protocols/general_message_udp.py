"""General Messages over UDP: one object per datagram, one peer at a time."""

from typing import Any

from twisted.internet.error import MessageLengthError
from twisted.internet.protocol import DatagramProtocol

from up.protocols.general_message import MalformedMessage, decode
from up.protocols.general_message_link import (
    MAX_BURST,
    MAX_MESSAGES_HZ,
    OnConnected,
    OnLost,
    OnMalformed,
    OnMessage,
    permits,
)
from up.system.clock import Clock, Timer, cancel
from up.system.token_bucket import TokenBucket

SILENCE_TIMEOUT_S = 1.5
_MAX_PACKET_SIZE = 65536


class GeneralMessageDatagrams(DatagramProtocol):
    """One port, one peer: an address stays the peer until it is silent for 1.5 s.

    The callbacks are those of `GeneralMessageProtocol`. An empty datagram is a heartbeat. Counters:
    `malformed`, `dropped` (send failed), `foreign` (from another address) and `bucket.refused`
    (beyond the rate).
    """

    transport: Any

    def __init__(
        self,
        clock: Clock,
        *,
        on_message: OnMessage,
        on_malformed: OnMalformed,
        on_connected: OnConnected,
        on_lost: OnLost,
        bucket: TokenBucket | None = None,
    ) -> None:
        self.bucket = bucket or TokenBucket(clock, MAX_MESSAGES_HZ, MAX_BURST)
        self.foreign = 0
        self.malformed = 0
        self.dropped = 0
        self._clock = clock
        self._on_message = on_message
        self._on_malformed = on_malformed
        self._on_connected = on_connected
        self._on_lost = on_lost
        self._address: Any = None
        self._heard_s = 0.0
        self._timer: Timer | None = None

    @property
    def peer(self) -> str:
        """Host and port of the peer; empty without one."""
        return "" if self._address is None else f"{self._address[0]}:{self._address[1]}"

    @property
    def heard_s(self) -> float:
        """The clock's time of the peer's newest datagram."""
        return self._heard_s

    def send(self, message: bytes) -> bool:
        if self._address is None or self.transport is None:
            self.dropped += 1
            return False
        try:
            self.transport.write(message, self._address)
        except (OSError, MessageLengthError):
            # The socket buffer is full or the network is down: datagrams may be lost.
            self.dropped += 1
            return False
        return True

    def send_newest(self, message: bytes) -> bool:
        return self.send(message)

    def close(self) -> None:
        """Drop the peer; the next datagram is a new link."""
        self._lose("closed")

    def startProtocol(self) -> None:  # noqa: N802 - Twisted's name
        """Allow messages longer than the 8 KiB to which a port truncates datagrams."""
        self.transport.maxPacketSize = _MAX_PACKET_SIZE

    def datagramReceived(self, datagram: bytes, addr: Any) -> None:  # noqa: N802 - Twisted's name
        if addr != self._address:
            if not self._admits(datagram, addr):
                self.foreign += 1
                return
            self._lose("replaced by another address")
        self._heard_s = self._clock.seconds()
        if self._address is None:
            self._address = addr
            self._timer = self._clock.callLater(SILENCE_TIMEOUT_S, self._check_idle)
            self._on_connected(self)
        if not datagram.strip(b"\r\n"):
            return
        if not permits(self.bucket, self.peer):
            return
        try:
            message = decode(datagram)
        except MalformedMessage as fault:
            self.malformed += 1
            self._on_malformed(self, fault)
        else:
            self._on_message(self, message)

    def stopProtocol(self) -> None:  # noqa: N802 - Twisted's name
        self._lose("the port was closed")

    def _admits(self, datagram: bytes, addr: Any) -> bool:
        return self._address is None

    def _check_idle(self) -> None:
        remaining = self._heard_s + SILENCE_TIMEOUT_S - self._clock.seconds()
        if remaining > 0:
            self._timer = self._clock.callLater(remaining, self._check_idle)
        else:
            self._lose(f"nothing heard for {SILENCE_TIMEOUT_S:g} s")

    def _lose(self, why: str) -> None:
        cancel(self._timer)
        if self._address is not None:
            self._address = None
            self._on_lost(self, why)
