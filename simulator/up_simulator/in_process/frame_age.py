"""The age of a telemetry frame on arrival, as far as its receiver can compute it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from up.protocols.general_message import GeneralMessage

FrameAge = Callable[[GeneralMessage, float], float | None]
"""Takes a frame and its arrival time (s); returns its age (s), None: not known."""
_ONE_LIFE = 1_000_000
"""Beacons of one life of the daemon are nearer: each life draws its first at random below 2**31."""


@dataclass(slots=True)
class _Life:
    beacon: int
    origin_s: float


class UptimeAges:
    """Measures ages by ``system.uptime_s``, for a daemon with an unreadable clock.

    In each run of the daemon the quickest frame counts as 0 s old. The uptime has whole seconds:
    an age is up to 1 s too great, and too small by at most that frame's own age and a telemetry
    period. A run is identified by its beacons, so that an old frame stays one.
    """

    def __init__(self) -> None:
        self._lives: list[_Life] = []

    def age_s(self, message: GeneralMessage, now_s: float) -> float | None:
        """Return the age of a frame that arrives now; None without a beacon or uptime."""
        system = message.data.get("system")
        uptime_s = system.get("uptime_s") if isinstance(system, dict) else None
        if message.beacon is None or isinstance(uptime_s, bool):
            return None
        if not isinstance(uptime_s, int | float):
            return None
        life = self._life(message.beacon, now_s - uptime_s)
        life.origin_s = min(life.origin_s, now_s - uptime_s)
        return now_s - uptime_s - life.origin_s

    def _life(self, beacon: int, origin_s: float) -> _Life:
        for life in self._lives:
            if abs(beacon - life.beacon) < _ONE_LIFE:
                return life
        life = _Life(beacon, origin_s)
        self._lives.append(life)
        return life
