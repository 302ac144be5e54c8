"""The actions of a pilot who gets the sticks back after a remote sender has disarmed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from up_simulator.radio.sticks import LOWEST_US, Sticks

LOW_S, HIGH_S = 0.7, 0.7
"""How long AUX2 stays on each side: the board believes it after 300 ms, and its status is late."""


class ArmingAgain:
    """Holds the throttle low and moves AUX2 from low to high, until the board is armed.

    ``is_armed`` returns the board's report, None before the first.
    """

    def __init__(self, is_armed: Callable[[], bool | None]) -> None:
        self._is_armed = is_armed
        self._begun_s: float | None = None

    def begin(self, time_s: float, left: Sticks) -> None:
        """Begin where it is needed: ``left`` is how the other pilot left the sticks."""
        if not left.is_armed or self._is_armed() is False:
            self._begun_s = time_s

    def sticks(self, time_s: float, own: Sticks) -> Sticks:
        """Return the pilot's ``own`` sticks, or those that arm while that is under way."""
        if self._begun_s is None or not own.is_armed:
            return own
        passed_s = time_s - self._begun_s
        if passed_s < LOW_S:
            return replace(own, throttle=LOWEST_US, aux2=LOWEST_US)
        is_over = passed_s >= LOW_S + HIGH_S
        if self._is_armed() or (is_over and self._is_armed() is None):
            self._begun_s = None
            return own
        if is_over:
            self._begun_s = time_s
        return replace(own, throttle=LOWEST_US)
