"""Forwards the location to an Arduino with the thesis's firmware."""

from __future__ import annotations

from arduino_cog.place_forward import PlaceForward
from arduino_cog.wire import pack_location
from up.commands.location_command import LocationCommand
from up.needs import needs
from up.providers.up_location_provider import UpLocationProvider


class ArduinoLocationModule(PlaceForward):
    """Forwards the position that the provider follows."""

    COMMAND = LocationCommand
    LETTER = "l"

    source = needs(UpLocationProvider)

    def pack(self, value: LocationCommand) -> bytes:
        """Return the location as the payload of ``l``."""
        return pack_location(value.latitude_deg, value.longitude_deg)
