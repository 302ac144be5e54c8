"""What the aircraft said last, and how old that is."""

from __future__ import annotations

import math
from collections import deque
from typing import Any

from up.protocols.general_message import GeneralMessage
from up_ground.safe_text import safe_text

NAME = "up.telemetry.update"
SILENT_S = 0.9
"""A frame that is older looks old on the screen, before the second is over."""
_STALE_S = {"location": 1.9, "altitude": 1.9, "heading": 1.9, "battery": 120.0}
"""Sources that come once a second or more seldom are stale later than SILENT_S."""
_LARGEST_GAP = 1000
_GREATEST = 1e12


class Telemetry:
    """The newest frame, read with suspicion: a field of a wrong type is a field not known.

    Times are the clock's seconds. ``lost`` counts the frames that the beacon's numbers say were
    sent and did not come. ``delay_s`` is the link's own delay as far as it is known.
    """

    def __init__(self) -> None:
        self.frames = 0
        self.lost = 0
        self.delay_s = 0.0
        self.beacon: int | None = None
        self.data: dict[str, Any] = {}
        self._received_s: float | None = None
        self._times_s: deque[float] = deque(maxlen=32)

    def take(self, message: GeneralMessage, now_s: float) -> bool:
        """Take a frame; False: the message is another one."""
        if message.name != NAME:
            return False
        if message.beacon is not None and self.beacon is not None:
            gap = message.beacon - self.beacon
            if 1 < gap <= _LARGEST_GAP:
                self.lost += gap - 1
        self.beacon = message.beacon
        self.data = message.data
        self.frames += 1
        self._received_s = now_s
        self._times_s.append(now_s)
        return True

    def age_s(self, now_s: float) -> float | None:
        """Return the age of the newest frame with the link's delay; None: there was none."""
        return None if self._received_s is None else now_s - self._received_s + self.delay_s

    def is_silent(self, now_s: float) -> bool:
        """Say whether nothing on the screen can be trusted to be of now."""
        age_s = self.age_s(now_s)
        return age_s is None or age_s > SILENT_S

    def reading_age_s(self, reading: str, now_s: float) -> float | None:
        """Return the age of a reading: on the aircraft, on the link and since; None: unknown."""
        age_s, there_ms = self.age_s(now_s), self.number("age_ms", reading)
        return None if age_s is None or there_ms is None else age_s + max(0.0, there_ms) / 1000

    def is_stale(self, reading: str, now_s: float) -> bool:
        """Say whether a reading is too old to be flown by; one without an age is as its frame."""
        if self.is_silent(now_s):
            return True
        age_s = self.reading_age_s(reading, now_s)
        return age_s is not None and age_s > _STALE_S.get(reading, SILENT_S)

    def rate_hz(self, now_s: float) -> float | None:
        """Return how many frames come a second; None while too few came or when they stopped."""
        times = self._times_s
        if len(times) < 3 or times[-1] <= times[0] or now_s - times[-1] > 10:
            return None
        return (len(times) - 1) / (max(now_s, times[-1]) - times[0])

    def number(self, *path: str) -> float | None:
        """Return a finite number at that key path; None: absent, null or something else."""
        found = self._at(path)
        if isinstance(found, bool) or not isinstance(found, int | float):
            return None
        return float(found) if math.isfinite(found) and abs(found) < _GREATEST else None

    def flag(self, *path: str) -> bool | None:
        """Return true or false at that key path; None: unknown."""
        found = self._at(path)
        return found if isinstance(found, bool) else None

    def text(self, *path: str, limit: int = 40) -> str | None:
        """Return a text at that key path, safe for a terminal; None: unknown."""
        found = self._at(path)
        return safe_text(found, limit) if isinstance(found, str) else None

    def texts(self, *path: str, limit: int = 80) -> list[str] | None:
        """Return a list of texts, safe for a terminal; None: unknown."""
        found = self._at(path)
        if not isinstance(found, list):
            return None
        return [safe_text(each, limit) for each in found[:32] if isinstance(each, str)]

    def _at(self, path: tuple[str, ...]) -> Any:
        found: Any = self.data
        for key in path:
            if not isinstance(found, dict):
                return None
            found = found.get(key)
        return found
