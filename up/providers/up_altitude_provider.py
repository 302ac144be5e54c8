"""The altitude of the aircraft."""

from collections.abc import Mapping
from typing import Any

from up.commands.altitude_command import AltitudeCommand
from up.commands.telemetry_schema import READINGS
from up.providers.base_provider import BaseProvider, Reading, require


class UpAltitudeProvider(BaseProvider[float]):
    """Provides the altitude, m above sea level, and the required altitude."""

    READING = "altitude"
    COMMAND = AltitudeCommand
    MAX_AGE_S = READINGS[READING].source_s

    @property
    def required_altitude(self) -> float | None:
        """Return the altitude that the flight controller holds at the ground's request, m."""
        control = self.up.flight_control
        required: float | None = control and control.required("altitude")
        return required

    @property
    def altitude(self) -> float | None:
        """Return the newest altitude, m."""
        return self.value

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        return {
            "altitude": self.altitude,
            "altitude_required": self.required_altitude,
            **self._ages(),
        }

    def _value_of(self, command: Any) -> float | None:
        if command.mode == "required":
            require(self.up.flight_control, "altitude", command.altitude_m)
            return None
        altitude: float = command.altitude_m
        return altitude

    def _on_changed(self, reading: Reading[float]) -> None:
        self._on_altitude_changed()

    def _on_altitude_changed(self) -> None:
        """Called for a new altitude."""
