"""The newest frame of telemetry, for adapters that send it on in another format."""

import math
from collections.abc import Mapping
from typing import Any

from up.commands.board_schema import PI_MODES
from up.commands.telemetry_schema import READINGS
from up.flight_log.json_message import value_at

MAX_POSITION_AGE_MS = READINGS["navigation"].stale_s * 1000


def acting_mode(board: str | None, pi: str | None) -> str | None:
    """Return the flight mode that acts, of the board's and that of the Raspberry Pi."""
    return pi or board if board in PI_MODES else board


class Frame:
    """Telemetry (docs/protocols.md, 6); a field of a wrong type counts as unknown."""

    def __init__(self, content: Mapping[str, Any] | None = None, beacon: int | None = None) -> None:
        self.content: Mapping[str, Any] = content or {}
        self.beacon = beacon

    def number(self, *path: str) -> float | None:
        found = value_at(self.content, path)
        is_number = isinstance(found, int | float) and not isinstance(found, bool)
        return float(found) if is_number and math.isfinite(found) else None

    def flag(self, *path: str) -> bool | None:
        found = value_at(self.content, path)
        return found if isinstance(found, bool) else None

    def text(self, *path: str) -> str | None:
        found = value_at(self.content, path)
        return found if isinstance(found, str) else None

    def texts(self, *path: str) -> list[str] | None:
        found = value_at(self.content, path)
        return [str(each) for each in found] if isinstance(found, list | tuple) else None

    def is_null(self, *path: str) -> bool:
        above = value_at(self.content, path[:-1])
        return isinstance(above, Mapping) and above.get(path[-1], "") is None

    def is_stale(self, reading: str, frame_age_s: float = 0.0) -> bool:
        """Return whether a reading is too old to fly by; one without an age is not."""
        age_ms = self.number("age_ms", reading)
        return age_ms is not None and age_ms / 1000 + frame_age_s > READINGS[reading].stale_s

    @property
    def mode(self) -> str:
        """Return the flight mode that acts: the Raspberry Pi's while it flies; empty: unknown."""
        board = self.text("flight_mode")
        return acting_mode(board, self.text("flight_control", "mode")) or ""

    @property
    def clock_ms(self) -> int:
        """Return the aircraft's monotonic clock, 32 bits."""
        return int(self.number("system", "clock_ms") or 0) & 0xFFFFFFFF

    @property
    def position(self) -> tuple[float, float] | None:
        """Return the estimated position, deg, or the receiver's; None: too old or unknown."""
        for part in ("navigation", "location"):
            latitude, longitude = self.number(part, "latitude"), self.number(part, "longitude")
            age_ms = self.number("age_ms", part)
            is_old = age_ms is not None and age_ms > MAX_POSITION_AGE_MS
            if latitude is not None and longitude is not None and not is_old:
                return latitude, longitude
        return None
