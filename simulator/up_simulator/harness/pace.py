"""Keeps a flight in step with a monotonic clock and never runs after it."""

from __future__ import annotations

from collections.abc import Callable

from up_simulator.aircraft.flight import Flight
from up_simulator.harness.clock import Clock

LATEST_S = 0.25
SAY_AGAIN_S = 5.0


class Pace:
    """Flies a flight in step with the clock.

    When the process was held up for more than 250 ms, the missed time is skipped instead of
    flown in a burst: catching up would make the next call late as well. It is added to
    ``skipped_s`` and reported at most every 5 s.
    """

    def __init__(self, flight: Flight, clock: Clock, say: Callable[[str], None]) -> None:
        self._flight = flight
        self._clock = clock
        self._say = say
        self._newest_s = clock.seconds()
        self._said_s: float | None = None
        self.skipped_s = 0.0

    def keep(self) -> None:
        """Fly until now."""
        now_s = self._clock.seconds()
        passed_s = now_s - self._newest_s
        self._newest_s = now_s
        if passed_s > LATEST_S:
            self.skipped_s += passed_s - LATEST_S
            if self._said_s is None or now_s - self._said_s >= SAY_AGAIN_S:
                self._said_s = now_s
                self._say(f"late by {passed_s:.2f} s: the missed time is skipped, not flown")
            passed_s = LATEST_S
        self._flight.advance(passed_s)
