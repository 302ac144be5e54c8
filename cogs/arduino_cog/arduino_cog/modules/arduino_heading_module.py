"""Forwards the heading to an Arduino with the thesis's firmware."""

from __future__ import annotations

from arduino_cog.place_forward import PlaceForward
from arduino_cog.wire import pack_heading
from up.commands.heading_command import HeadingCommand
from up.needs import needs
from up.providers.up_heading_provider import UpHeadingProvider


class ArduinoHeadingModule(PlaceForward):
    """Forwards the heading that the provider follows, in whole degrees."""

    COMMAND = HeadingCommand
    LETTER = "b"

    source = needs(UpHeadingProvider)

    def pack(self, value: float) -> bytes:
        """Return the heading as the payload of ``b``."""
        return pack_heading(value)
