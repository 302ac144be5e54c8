"""The heading of the aircraft."""

from collections.abc import Mapping
from typing import Any

from up.commands.heading_command import HeadingCommand
from up.commands.telemetry_schema import READINGS
from up.earth import compass_deg
from up.providers.base_provider import BaseProvider, Reading, require


class UpHeadingProvider(BaseProvider[float]):
    """Provides the measured and the required heading, deg clockwise from north."""

    READING = "heading"
    COMMAND = HeadingCommand
    MAX_AGE_S = READINGS[READING].source_s

    @property
    def required_heading(self) -> float | None:
        """Return the course that the flight controller follows at the ground's request, deg."""
        control = self.up.flight_control
        required: float | None = control and control.required("course")
        return required

    @property
    def actual_heading(self) -> float | None:
        """Return the newest measured heading, deg."""
        return self.value

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        return {
            "heading": {"actual": self.actual_heading, "required": self.required_heading},
            **self._ages(),
        }

    def _value_of(self, command: Any) -> float | None:
        heading = compass_deg(command.heading_deg)
        if command.mode == "required":
            require(self.up.flight_control, "course", heading)
            self._on_required_heading_changed()
            return None
        return heading

    def _on_changed(self, reading: Reading[float]) -> None:
        self._on_actual_heading_changed()

    def _on_actual_heading_changed(self) -> None:
        """Called for a new measured heading."""

    def _on_required_heading_changed(self) -> None:
        """Called for a new required heading."""
