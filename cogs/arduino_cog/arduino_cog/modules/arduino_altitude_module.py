"""Forwards the altitude to an Arduino with the thesis's firmware."""

from __future__ import annotations

from arduino_cog.place_forward import PlaceForward
from arduino_cog.wire import pack_altitude
from up.commands.altitude_command import AltitudeCommand
from up.needs import needs
from up.providers.up_altitude_provider import UpAltitudeProvider


class ArduinoAltitudeModule(PlaceForward):
    """Forwards the altitude that the provider follows, in whole metres."""

    COMMAND = AltitudeCommand
    LETTER = "h"

    source = needs(UpAltitudeProvider)

    def pack(self, value: float) -> bytes:
        """Return the altitude as the payload of ``h``."""
        return pack_altitude(value)
