"""The location of the aircraft, and the distance and bearing to home."""

from collections.abc import Mapping
from typing import Any

from up.commands.location_command import LocationCommand
from up.commands.telemetry_schema import READINGS
from up.earth import bearing_deg, distance_m
from up.providers.base_provider import BaseProvider, Reading


class UpLocationProvider(BaseProvider[LocationCommand]):
    """Provides the position (WGS 84), and distance and bearing to the first one."""

    READING = "location"
    COMMAND = LocationCommand
    MAX_AGE_S = READINGS[READING].source_s

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        super().__init__(config, silent)
        self.home: LocationCommand | None = None

    @property
    def latitude(self) -> float | None:
        """Return the newest latitude, deg."""
        return None if self._reading is None else self._reading.value.latitude_deg

    @property
    def longitude(self) -> float | None:
        """Return the newest longitude, deg."""
        return None if self._reading is None else self._reading.value.longitude_deg

    @property
    def altitude(self) -> float | None:
        """Return the newest altitude that came with a position, m."""
        return None if self._reading is None else self._reading.value.altitude_m

    @property
    def satellites(self) -> int | None:
        """Return how many satellites the newest fix uses."""
        return None if self._reading is None else self._reading.value.satellites

    @property
    def distance_from_home(self) -> float | None:
        """Return the distance to the first position, m."""
        if self._reading is None or self.home is None:
            return None
        return distance_m(*_point(self._reading.value), *_point(self.home))

    @property
    def required_bearing(self) -> float | None:
        """Return the bearing to the first position, deg clockwise from north."""
        if self._reading is None or self.home is None:
            return None
        return bearing_deg(*_point(self._reading.value), *_point(self.home))

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        newest = self.value
        return {
            "location": {
                "latitude": self.latitude,
                "longitude": self.longitude,
                "altitude": self.altitude,
                "satellites": self.satellites,
                "accuracy": newest and newest.accuracy_m,
                "fix": newest and newest.fix,
                "pdop": newest and newest.pdop,
            },
            "home": {"distance": self.distance_from_home, "bearing": self.required_bearing},
            **self._ages(),
        }

    def _on_changed(self, reading: Reading[LocationCommand]) -> None:
        if self.home is None:
            self.home = reading.value
        self._on_location_changed()

    def _on_location_changed(self) -> None:
        """Called for a new location."""


def _point(location: LocationCommand) -> tuple[float, float]:
    return location.latitude_deg, location.longitude_deg
