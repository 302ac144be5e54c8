"""Answers discovery requests for the Raspberry Pi's address (docs/protocols.md 7)."""

from __future__ import annotations

import socket
from collections import Counter, OrderedDict
from collections.abc import Callable
from typing import Any

from twisted.internet.protocol import DatagramProtocol

from up.system.addresses import is_private
from up.system.clock import Clock
from up.system.token_bucket import TokenBucket

MAX_REQUEST_BYTES = 512
MAX_ANSWERS_HZ = 256.0
SENDER_ANSWERS_HZ = 10
MAX_SENDERS = 256


class Answerer(DatagramProtocol):
    """Answers any datagram of up to 512 bytes with our address on the sender's subnet, as text.

    Answers private networks only: a request from elsewhere searches for a target, or uses this host
    to send to a third party. ``counters`` counts the requests without an answer, by reason.
    """

    noisy = False
    transport: Any

    def __init__(
        self, limit: RateLimit, own_address_towards: Callable[[str, int], str | None]
    ) -> None:
        self.counters: Counter[str] = Counter()
        self._limit = limit
        self._own_address_towards = own_address_towards

    def datagramReceived(self, datagram: bytes, addr: Any) -> None:  # noqa: N802 - Twisted's name
        host, port = addr[0], addr[1]
        if len(datagram) > MAX_REQUEST_BYTES:
            self.counters["too_long"] += 1
        elif port == 0 or not is_private(host):
            self.counters["foreign"] += 1
        elif not self._limit.permits(host):
            self.counters["too_often"] += 1
        else:
            self._answer(host, port)

    def _answer(self, host: str, port: int) -> None:
        own = self._own_address_towards(host, port)
        if own is None:
            self.counters["unreachable"] += 1
            return
        try:
            self.transport.write(own.encode("ascii"), (host, port))
        except OSError:
            # The network was lost between the two calls; the phone repeats its request.
            self.counters["unreachable"] += 1
        else:
            self.counters["answered"] += 1


class RateLimit:
    """Permits ``SENDER_ANSWERS_HZ`` to each sender; remembers ``MAX_SENDERS`` at most.

    All senders together get `MAX_ANSWERS_HZ`: a flood of forged addresses costs bounded memory and
    bounded traffic.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._all = TokenBucket(clock, MAX_ANSWERS_HZ, MAX_ANSWERS_HZ)
        self._buckets: OrderedDict[str, TokenBucket] = OrderedDict()

    def __len__(self) -> int:
        return len(self._buckets)

    def permits(self, sender: str) -> bool:
        """Count a request and return whether it may be answered."""
        bucket = self._buckets.pop(sender, None)
        if bucket is None:
            bucket = TokenBucket(self._clock, SENDER_ANSWERS_HZ, SENDER_ANSWERS_HZ)
        self._buckets[sender] = bucket
        if len(self._buckets) > MAX_SENDERS:
            self._buckets.popitem(last=False)
        return bucket.take() and self._all.take()


def own_address_towards(host: str, port: int) -> str | None:
    """Return our IPv4 address on the route to a peer, or None without a route.

    A connected UDP socket asks the routing table; nothing is sent.
    """
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.connect((host, port))
            address: str = probe.getsockname()[0]
            return address
    except OSError:
        return None
