"""The altitude of the aircraft."""

from collections.abc import Mapping
from typing import Any

from up.commands.altitude_command import AltitudeCommand
from up.commands.telemetry_schema import READINGS
from up.providers.base_provider import BaseProvider, require


class UpAltitudeProvider(BaseProvider[float]):
    """Provides the altitude, m above sea level, and the required altitude."""

    READING = "altitude"
    COMMAND = AltitudeCommand
    MAX_AGE_S = READINGS[READING].source_s

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        control = self.up.flight_control
        return {
            "altitude": self.value,
            "altitude_required": control and control.required("altitude"),
            **self._ages(),
        }

    def _value_of(self, command: Any) -> float | None:
        if command.mode == "required":
            require(self.up.flight_control, "altitude", command.altitude_m)
            return None
        altitude: float = command.altitude_m
        return altitude
