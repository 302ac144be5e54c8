"""How long to wait before the next attempt to connect."""

from __future__ import annotations

import random
from collections.abc import Callable

FIRST_S = 0.2
LONGEST_S = 2.0
"""Short enough that a proxy which is back is found within 3 s."""
JITTER = 0.2


class Backoff:
    """Doubles the pause after each failure, each shortened by up to a fifth.

    The jitter keeps many grounds from coming back to a proxy in one instant.
    """

    def __init__(self, draw: Callable[[], float] = random.random) -> None:
        self._draw = draw
        self._next_s = FIRST_S

    def reset(self) -> None:
        """Begin anew: the link was good."""
        self._next_s = FIRST_S

    def pause_s(self) -> float:
        """Return the next pause."""
        pause_s = self._next_s * (1 - JITTER * self._draw())
        self._next_s = min(self._next_s * 2, LONGEST_S)
        return pause_s
