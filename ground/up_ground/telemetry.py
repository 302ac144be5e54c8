"""The newest telemetry of the aircraft, and its age."""

from __future__ import annotations

import math
from collections import deque
from typing import Any

from up.commands.telemetry_schema import LATE_FOR_S, LATE_S, READINGS, SILENT_S
from up.flight_log.json_message import value_at
from up.protocols.general_message import GeneralMessage
from up.sanitize_text import sanitize_text
from up_ground.one_way_delay import OneWayDelayEstimator

NAME = "up.telemetry.update"
_MAX_GAP = 1000
_MAX_BEACON_STEP = 1_000_000
"""Beacons of one life of an aircraft are nearer: each life draws its first at random."""
_MAX_NUMBER = 1e12


class Telemetry:
    """The newest frame, validated: a field of a wrong type counts as unknown.

    Times are the clock's seconds. ``lost`` counts frames that, by the beacon numbers, were sent
    but did not arrive, or arrived too late. ``way_s`` is the known part of the newest frame's
    transit time: half of the round trip to the proxy, plus its delay against the quickest frame
    by the aircraft's own clock, if it is reported (``system.clock_ms``).
    """

    def __init__(self) -> None:
        self.frames = 0
        self.lost = 0
        self.beacon: int | None = None
        self.data: dict[str, Any] = {}
        self._received_s: float | None = None
        self._delay = OneWayDelayEstimator()
        self._held_s: float | None = None
        self._left_out = 0
        self._stamp_ms: float | None = None
        self._late_since_s: float | None = None
        self._round_trip_s = 0.0
        self._least_trip_s: float | None = None
        self._clock: tuple[float, float, float] | None = None
        self._times_s: deque[float] = deque(maxlen=32)

    def update(self, message: GeneralMessage, now_s: float) -> bool:
        """Take a frame; False: it is another message, or a newer frame follows it."""
        if message.name != NAME:
            return False
        gap = 0
        if message.beacon is not None and self.beacon is not None:
            gap = message.beacon - self.beacon
            if abs(gap) > _MAX_BEACON_STEP:
                self._delay.reset()
        stamp_ms = _number(value_at(message.data, ("system", "clock_ms")))
        held_s = self._delay.update(stamp_ms, now_s)
        if self._is_superseded(stamp_ms, held_s, now_s):
            return False
        left_out = int(_number(value_at(message.data, ("uplink", "left_out"))) or 0)
        lost = gap - 1 - max(0, left_out - self._left_out)
        if 0 < lost <= _MAX_GAP:
            self.lost += lost
        self._left_out = left_out
        self.beacon = message.beacon
        self.data = message.data
        self.frames += 1
        self._held_s = held_s
        if self._delay.has_begun:
            self._least_trip_s = self._round_trip_s or None
        self._received_s = now_s
        self._times_s.append(now_s)
        return True

    def _is_superseded(self, stamp_ms: float | None, held_s: float | None, now_s: float) -> bool:
        """Return whether the next frame left before this late one arrived, as in a link outage."""
        before_ms, self._stamp_ms = self._stamp_ms, stamp_ms
        period_s = (stamp_ms - before_ms) / 1000 if stamp_ms and before_ms else math.inf
        if held_s is None or held_s <= max(LATE_S, period_s):
            self._late_since_s = None
            return False
        if self._late_since_s is None:
            self._late_since_s = now_s
        return now_s - self._late_since_s < LATE_FOR_S

    def on_round_trip(self, round_trip_ms: float | None) -> None:
        """Take how long it is to the proxy and back now; None: not known."""
        self._round_trip_s = (round_trip_ms or 0.0) / 1000
        if round_trip_ms is not None:
            self._least_trip_s = min(self._round_trip_s, self._least_trip_s or self._round_trip_s)

    def on_clock(self, clock: tuple[float, float, float] | None) -> None:
        """Take the aircraft's clock as a protected session reports it, once for each session."""
        if clock is not None and clock != self._clock:
            self._clock = clock
            self._delay.trust(*clock)

    @property
    def way_s(self) -> float:
        """Return how long the newest frame was on its way, as far as that is known."""
        if self._held_s is None:
            return self._round_trip_s / 2
        if self._clock is not None:
            # By a clock that was compared: the whole way.
            return max(self._held_s, self._round_trip_s / 2)
        # The held time includes the queue before the proxy: its minimum is the path itself.
        return (self._least_trip_s or self._round_trip_s) / 2 + self._held_s

    def age_s(self, now_s: float) -> float | None:
        """Return the age of the newest frame with its way; None: there was none."""
        return None if self._received_s is None else now_s - self._received_s + self.way_s

    def is_late(self, now_s: float) -> bool:
        """Return whether frames arrive, but so late that they count as silence."""
        received_s = self._received_s
        return received_s is not None and now_s - received_s <= SILENT_S < self.way_s

    def is_silent(self, now_s: float) -> bool:
        """Return whether every value on the screen may be stale."""
        age_s = self.age_s(now_s)
        return age_s is None or age_s > SILENT_S

    def reading_age_s(self, reading: str, now_s: float) -> float | None:
        """Return the age of a reading: on the aircraft, on the link and since; None: unknown."""
        age_s, there_ms = self.age_s(now_s), self.number("age_ms", reading)
        return None if age_s is None or there_ms is None else age_s + max(0.0, there_ms) / 1000

    def is_stale(self, reading: str, now_s: float) -> bool:
        """Return whether a reading is too old to fly by; without an age it is as its frame."""
        if self.is_silent(now_s):
            return True
        age_s = self.reading_age_s(reading, now_s)
        limit_s = READINGS[reading].stale_s if reading in READINGS else SILENT_S
        return age_s is not None and age_s > limit_s

    def rate_hz(self, now_s: float) -> float | None:
        """Return the frames per second; None after too few frames or in a silence."""
        times = self._times_s
        if len(times) < 3 or times[-1] <= times[0] or now_s - times[-1] > 10:
            return None
        return (len(times) - 1) / (max(now_s, times[-1]) - times[0])

    def number(self, *path: str) -> float | None:
        """Return a finite number at that key path; None if absent, null or of another type."""
        return _number(value_at(self.data, path))

    def flag(self, *path: str) -> bool | None:
        """Return true or false at that key path; None: unknown."""
        found = value_at(self.data, path)
        return found if isinstance(found, bool) else None

    def text(self, *path: str, limit: int = 40) -> str | None:
        """Return a text at that key path, safe for a terminal; None: unknown."""
        found = value_at(self.data, path)
        return sanitize_text(found, limit) if isinstance(found, str) else None

    def is_null(self, *path: str) -> bool:
        """Return whether the aircraft reports null at that key path."""
        above = value_at(self.data, path[:-1])
        return isinstance(above, dict) and above.get(path[-1], "") is None

    def texts(self, *path: str, limit: int = 80) -> list[str] | None:
        """Return a list of texts, safe for a terminal; None: unknown."""
        found = value_at(self.data, path)
        if not isinstance(found, list):
            return None
        return [sanitize_text(each, limit) for each in found[:32] if isinstance(each, str)]


def _number(found: Any) -> float | None:
    if isinstance(found, bool) or not isinstance(found, int | float):
        return None
    return float(found) if math.isfinite(found) and abs(found) < _MAX_NUMBER else None
