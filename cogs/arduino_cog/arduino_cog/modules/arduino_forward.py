"""Forwards readings to an Arduino with the thesis's firmware; this project's does not use them."""

from typing import Any

from serial_cog.config import ARDUINO

from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.on_change_sender import OnChangeSender
from arduino_cog.wire import pack_altitude, pack_heading, pack_location
from up.base_started_module import BaseStartedModule
from up.commands.location_command import LocationCommand
from up.mode import WITH_BOARD
from up.needs import needs
from up.providers.base_provider import Reading
from up.providers.up_altitude_provider import UpAltitudeProvider
from up.providers.up_heading_provider import UpHeadingProvider
from up.providers.up_location_provider import UpLocationProvider


class ReadingForward(BaseStartedModule):
    """Forwards each new valid reading of ``source`` once, as the stream ``LETTER``.

    A subclass names the provider as ``source``, and the packing of a value.
    """

    MODES = WITH_BOARD
    LETTER: str

    arduino = needs(ArduinoProvider)
    source: Any

    def load(self) -> bool:
        return bool(self.context.config(ARDUINO).framing == "thesis")

    def pack(self, value: Any) -> bytes:
        raise NotImplementedError

    def on_init(self) -> None:
        self._sender = OnChangeSender(
            self.context.reactor, lambda payload: self.arduino.send_stream(self.LETTER, payload)
        )
        self.arduino.add_board_listener(self._sender.reset)
        self.source.subscribe(self.on_reading)

    def on_stop(self) -> None:
        self._sender.stop()

    def on_reading(self, reading: Reading[Any]) -> None:
        if self.started:
            self._sender.offer(self.pack(reading.value))


class ArduinoAltitudeModule(ReadingForward):
    """Forwards the altitude that the provider follows, in whole metres."""

    LETTER = "h"
    source = needs(UpAltitudeProvider)

    def pack(self, value: float) -> bytes:
        return pack_altitude(value)


class ArduinoHeadingModule(ReadingForward):
    """Forwards the heading that the provider follows, in whole degrees."""

    LETTER = "b"
    source = needs(UpHeadingProvider)

    def pack(self, value: float) -> bytes:
        return pack_heading(value)


class ArduinoLocationModule(ReadingForward):
    """Forwards the position that the provider follows."""

    LETTER = "l"
    source = needs(UpLocationProvider)

    def pack(self, value: LocationCommand) -> bytes:
        return pack_location(value.latitude_deg, value.longitude_deg)
