"""The beacons of an aircraft's recent telemetry: proof that a page has seen fresh data."""

from __future__ import annotations

from collections import deque

from up.commands.beacon import fresh_s
from up.system.clock import Clock
from up_ground.telemetry import Telemetry

KEPT = 512
"""No aircraft sends more frames than this while a beacon is fresh."""


class HeardBeacons:
    """Judges the beacon that a page echoes, before the aircraft does."""

    def __init__(self, clock: Clock, telemetry: Telemetry) -> None:
        self._clock = clock
        self._telemetry = telemetry
        self._frames = 0
        self._has_beacons = False
        self._heard: deque[tuple[float, int]] = deque(maxlen=KEPT)

    def look(self) -> None:
        """Remember the newest frame's; called after each frame."""
        telemetry = self._telemetry
        if telemetry.frames == self._frames:
            return
        self._frames = telemetry.frames
        if telemetry.beacon is not None:
            self._has_beacons = True
            self._heard.append((self._clock.seconds(), telemetry.beacon))

    def fault(self, name: str, beacon: int | None) -> tuple[str, str] | None:
        """Return why a Command is not sent with this beacon: the code and a sentence.

        An aircraft whose telemetry has no beacons, as the thesis's, takes Commands without one.
        """
        if beacon is None:
            if self._frames and not self._has_beacons:
                return None
            reason = f"not sent: {name} is only sent with the beacon of telemetry that was seen"
            return "no_beacon", reason
        newest = max((each for _, each in self._heard), default=beacon)
        if beacon > newest:
            return "unknown_beacon", "not sent: the aircraft has not sent the echoed beacon yet"
        limit_s = fresh_s(self._telemetry.number("system", "period_ms") or 0.0)
        oldest_s = self._clock.seconds() - limit_s
        if any(heard_s >= oldest_s for heard_s, each in self._heard if each == beacon):
            return None
        return "stale", f"not sent: the telemetry that this page shows is older than {limit_s:g} s"
