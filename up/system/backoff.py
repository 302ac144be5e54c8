"""The delay between two connection attempts of a link to a proxy."""

import random
from collections.abc import Callable

INITIAL_DELAY_S = 0.3
MAX_DELAY_S = 2.4
"""Maximum distance between attempts: a restored link is found within 3 s."""
JITTER = 0.2


class Backoff:
    """Doubles the distance between the starts of attempts, each shortened by up to a fifth.

    The jitter keeps many peers from reconnecting to a proxy at the same moment.
    """

    def __init__(self, draw: Callable[[], float] = random.random) -> None:
        self._draw = draw
        self._next_s = INITIAL_DELAY_S

    def reset(self) -> None:
        self._next_s = INITIAL_DELAY_S

    def pause_s(self, spent_s: float = 0.0) -> float:
        """Return the delay after an attempt that took ``spent_s``, at least ``INITIAL_DELAY_S``."""
        distance_s = self._next_s * (1 - JITTER * self._draw())
        self._next_s = min(self._next_s * 2, MAX_DELAY_S)
        return max(INITIAL_DELAY_S * (1 - JITTER), distance_s - spent_s)
