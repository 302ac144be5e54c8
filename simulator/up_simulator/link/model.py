"""One direction of a link: the arrival times of packets."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

from up.config import key


@dataclass(frozen=True, slots=True)
class LinkSettings:
    """One direction of a link; raises ValueError for impossible values.

    Every packet takes ``delay_ms`` and up to ``jitter_ms`` more. ``loss_percent`` of the packets
    are lost, independently. ``rate_bytes_s`` is the rate of the bottleneck, before which packets
    queue; 0 means no bottleneck.
    """

    delay_ms: float = key(0.0, "Transit time of each packet.", unit="ms", minimum=0, maximum=60_000)
    jitter_ms: float = key(
        0.0, "Maximum random additional transit time.", unit="ms", minimum=0, maximum=60_000
    )
    loss_percent: float = key(
        0.0,
        "Share of lost packets; TCP retransmits them.",
        unit="%",
        minimum=0,
        maximum=100,
    )
    rate_bytes_s: float = key(
        0.0, "Maximum bytes per second; 0: unlimited.", unit="B/s", minimum=0, maximum=1e9
    )

    def __post_init__(self) -> None:
        for name in ("delay_ms", "jitter_ms", "loss_percent", "rate_bytes_s"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise ValueError(f"{name} is a finite number from 0, not {value!r}")
        if self.loss_percent > 100:
            raise ValueError(f"loss_percent is at most 100, not {self.loss_percent!r}")


INITIAL_RETRY_S = 0.2
"""The least time after which TCP sends a lost packet again (Linux; RFC 6298 requires 1 s)."""
MAX_RETRY_S = 3.0
MAX_RETRIES = 12
"""A packet lost more often than this counts as arrived, so that time advances."""


class LinkModel:
    """Computes when each packet arrives, independent of sockets and clocks.

    The same seed, settings and calls give the same times. Times are seconds of the caller's clock
    and must not go back. Order is kept, for datagrams as well, as on a cellular link.

    ``settings`` may be replaced at any time: new ones hold for later packets. ``blackouts`` counts
    the blackouts so far: packets in flight at the start of one are lost.
    """

    def __init__(self, settings: LinkSettings | None = None, seed: int = 1) -> None:
        self.settings = settings or LinkSettings()
        self._random = random.Random(seed)
        self._is_free_s = -math.inf
        self._newest_s = -math.inf
        self._resumed_s = -math.inf
        self._is_stalled = False
        self.is_black = False
        self.blackouts = 0

    def send(self, size: int, now_s: float, *, is_datagram: bool = False) -> float | None:
        """Return when a packet of ``size`` bytes arrives, or None: it never does.

        A stream's packet is lost only in a blackout or at a loss of 100 %: otherwise a loss costs
        it the time of TCP's retransmissions. During a stall the result is the time without the
        stall; call ``arrival_s`` at that time.
        """
        settings = self.settings
        began_s = max(now_s, self._is_free_s)
        left_s = began_s + (size / settings.rate_bytes_s if settings.rate_bytes_s else 0.0)
        # Drawn for every packet, lost or not, so that a fault does not shift all later draws.
        jitter_s = self._random.random() * settings.jitter_ms / 1000
        retries = self._retries()
        # A lost packet may still have filled the bottleneck; a blackout is before it.
        if self.is_black or retries is None:
            return None
        self._is_free_s = left_s
        if is_datagram and retries:
            return None
        again_s = self._retry_s(retries)
        arrives_s = left_s + settings.delay_ms / 1000 + jitter_s + again_s
        self._newest_s = max(arrives_s, self._newest_s, self._resumed_s)
        return self._newest_s

    def arrival_s(self, due_s: float) -> float:
        """Return when a packet arrives that was due then: infinity while the link is stalled."""
        return math.inf if self._is_stalled else max(due_s, self._resumed_s)

    def stall(self) -> None:
        """Hold all packets from now on, those in flight included; nothing is lost."""
        self._is_stalled = True

    def resume(self, now_s: float) -> None:
        """End a stall: all held packets arrive now."""
        if self._is_stalled:
            self._is_stalled = False
            self._resumed_s = now_s

    def black_out(self) -> None:
        """Lose all packets, those in flight included, without a notification."""
        if not self.is_black:
            self.is_black = True
            self.blackouts += 1

    def restore(self) -> None:
        self.is_black = False

    def _retries(self) -> int | None:
        """Return how often a packet is lost before it arrives; None: always."""
        loss = self.settings.loss_percent / 100
        draw = self._random.random()
        if loss <= 0:
            return 0
        if loss >= 1:
            return None
        # One draw yields the number of losses: that of a geometric distribution.
        return min(MAX_RETRIES, int(math.log(max(draw, 1e-300)) / math.log(loss)))

    def _retry_s(self, retries: int) -> float:
        wait_s = INITIAL_RETRY_S + 2 * self.settings.delay_ms / 1000
        total_s = 0.0
        for _ in range(retries):
            total_s += min(wait_s, MAX_RETRY_S)
            wait_s *= 2
        return total_s
