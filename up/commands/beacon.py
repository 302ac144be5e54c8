"""Beacons: the age of the newest telemetry that the sender of a Command had received."""

from collections import deque
from random import Random, SystemRandom

from up.system.clock import Clock

MAX_BEACONS = 4096
FRESH_S = 2.0
ROUND_TRIP_S = 1.0
"""Allowance for the round trip of frame and Command, in addition to the telemetry period."""


def fresh_s(period_ms: float) -> float:
    """Return the maximum age of an echoed beacon; a ground that gets every frame stays below it."""
    return max(FRESH_S, period_ms / 1000 + ROUND_TRIP_S)


class Beacons:
    """Numbers telemetry frames and checks the number that a Command echoes.

    The first number is random, so that numbers of an earlier run are not mistaken for this run's.
    Age is monotonic seconds since the frame was sent.
    """

    def __init__(self, clock: Clock, random: Random | None = None) -> None:
        self._clock = clock
        self._run_start = self._first = self._next = (random or SystemRandom()).randrange(2**31)
        self._times: deque[float] = deque(maxlen=MAX_BEACONS)
        self.limit_s = FRESH_S

    def draw(self) -> int:
        """Return the number for a frame that is being sent."""
        number = self._next
        self._next += 1
        if len(self._times) == MAX_BEACONS:
            self._first += 1
        self._times.append(self._clock.seconds())
        return number

    def was_sent(self, number: int) -> bool:
        return self._run_start <= number < self._next

    def age_s(self, number: int) -> float | None:
        """Return the age of an echoed number; None for an unknown or forgotten number."""
        if not self._first <= number < self._next:
            return None
        return self._clock.seconds() - self._times[number - self._first]

    def is_fresh(self, number: int) -> bool:
        """Return whether an echoed number is at most ``limit_s`` old."""
        age = self.age_s(number)
        return age is not None and age <= self.limit_s
