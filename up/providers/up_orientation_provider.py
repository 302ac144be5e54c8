"""The orientation of the aircraft."""

from collections.abc import Mapping
from math import isfinite
from typing import Any

from up.commands.orientation_command import OrientationCommand
from up.commands.telemetry_schema import READINGS
from up.providers.base_provider import BaseProvider


class UpOrientationProvider(BaseProvider[OrientationCommand]):
    """Provides attitude (deg) and rates (deg/s), from any link."""

    READING = "orientation"
    COMMAND = OrientationCommand
    MAX_AGE_S = READINGS[READING].source_s

    def _is_valid(self, command: Any) -> bool:
        # Modules build the Command without validation; one NaN would persist in a controller.
        return isfinite(
            command.roll_deg
            + command.pitch_deg
            + command.yaw_deg
            + (command.roll_rate_deg_s or 0.0)
            + (command.pitch_rate_deg_s or 0.0)
            + (command.yaw_rate_deg_s or 0.0)
        )

    @property
    def roll(self) -> float | None:
        """Return the newest roll angle, deg."""
        return None if self._reading is None else self._reading.value.roll_deg

    @property
    def pitch(self) -> float | None:
        """Return the newest pitch angle, deg."""
        return None if self._reading is None else self._reading.value.pitch_deg

    @property
    def yaw(self) -> float | None:
        """Return the newest yaw angle, deg."""
        return None if self._reading is None else self._reading.value.yaw_deg

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        newest = None if self._reading is None else self._reading.value
        return {
            "orientation": {"yaw": self.yaw, "pitch": self.pitch, "roll": self.roll},
            "rates": {
                "yaw": newest and newest.yaw_rate_deg_s,
                "pitch": newest and newest.pitch_rate_deg_s,
                "roll": newest and newest.roll_rate_deg_s,
            },
            **self._ages(),
        }
