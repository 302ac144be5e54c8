"""The settings of one direction of a link."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LinkSettings:
    """One direction of a link; raises ValueError for impossible values.

    Every packet takes ``delay_ms`` and up to ``jitter_ms`` more. ``loss_percent`` of the packets
    are lost, independently. ``rate_bytes_s`` is the rate of the bottleneck, before which packets
    queue; 0 means no bottleneck.
    """

    delay_ms: float = 0.0
    jitter_ms: float = 0.0
    loss_percent: float = 0.0
    rate_bytes_s: float = 0.0

    def __post_init__(self) -> None:
        for name in ("delay_ms", "jitter_ms", "loss_percent", "rate_bytes_s"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise ValueError(f"{name} is a finite number from 0, not {value!r}")
        if self.loss_percent > 100:
            raise ValueError(f"loss_percent is at most 100, not {self.loss_percent!r}")
