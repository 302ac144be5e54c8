"""Answers discovery requests for the Raspberry Pi's address (docs/protocols.md 7)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any

from twisted.internet.protocol import DatagramProtocol

from discovery_cog.rate_limit import RateLimit
from up.system.addresses import is_private

LONGEST_QUESTION = 512


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
        """Answer a request."""
        host, port = addr[0], addr[1]
        if len(datagram) > LONGEST_QUESTION:
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
