"""How long a link to a proxy waits between two attempts."""

from __future__ import annotations

import random
from collections.abc import Callable

FIRST_S = 0.3
LONGEST_S = 2.4
"""Attempts begin at most so far apart: a link that works again is found within 3 s."""
JITTER = 0.2


class Backoff:
    """Doubles the distance between the beginnings of attempts, each shortened by up to a fifth.

    The jitter keeps many peers from coming back to a proxy in one instant.
    """

    def __init__(self, draw: Callable[[], float] = random.random) -> None:
        self._draw = draw
        self._next_s = FIRST_S

    def reset(self) -> None:
        """Begin anew: the link was good."""
        self._next_s = FIRST_S

    def pause_s(self, spent_s: float = 0.0) -> float:
        """Return how long to wait after an attempt that took ``spent_s``, at least ``FIRST_S``."""
        distance_s = self._next_s * (1 - JITTER * self._draw())
        self._next_s = min(self._next_s * 2, LONGEST_S)
        return max(FIRST_S * (1 - JITTER), distance_s - spent_s)
