"""The heading of the aircraft."""

from collections.abc import Mapping
from typing import Any

from up.commands.heading_command import HeadingCommand
from up.commands.telemetry_schema import READINGS
from up.earth import compass_deg
from up.providers.base_provider import BaseProvider, require


class UpHeadingProvider(BaseProvider[float]):
    """Provides the measured and the required heading, deg clockwise from north."""

    READING = "heading"
    COMMAND = HeadingCommand
    MAX_AGE_S = READINGS[READING].source_s

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        control = self.up.flight_control
        required = control and control.required("course")
        return {"heading": {"actual": self.value, "required": required}, **self._ages()}

    def _value_of(self, command: Any) -> float | None:
        heading = compass_deg(command.heading_deg)
        if command.mode == "required":
            require(self.up.flight_control, "course", heading)
            return None
        return heading
