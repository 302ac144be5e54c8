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

    home: LocationCommand | None = None
    """The first position, or the one that the flight controller keeps."""

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        newest, home = self.value, self.home
        way = None
        if newest is not None and home is not None:
            way = (newest.latitude_deg, newest.longitude_deg, home.latitude_deg, home.longitude_deg)
        return {
            "location": {
                "latitude": newest and newest.latitude_deg,
                "longitude": newest and newest.longitude_deg,
                "altitude": newest and newest.altitude_m,
                "satellites": newest and newest.satellites,
                "accuracy": newest and newest.accuracy_m,
                "fix": newest and newest.fix,
                "pdop": newest and newest.pdop,
            },
            "home": {"distance": way and distance_m(*way), "bearing": way and bearing_deg(*way)},
            **self._ages(),
        }

    def _on_changed(self, reading: Reading[LocationCommand]) -> None:
        if self.home is None:
            self.home = reading.value
