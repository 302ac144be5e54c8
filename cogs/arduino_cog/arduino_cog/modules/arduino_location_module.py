"""The location on its way to an Arduino with the thesis's firmware."""

from __future__ import annotations

from serial_cog.config import ARDUINO

from arduino_cog.change_sender import ChangeSender
from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import pack_location
from up.base_started_module import BaseStartedModule
from up.commands.location_command import LocationCommand
from up.mode import WITH_ARDUINO
from up.needs import needs
from up.providers.reading import Reading
from up.providers.up_location_provider import UpLocationProvider


class ArduinoLocationModule(BaseStartedModule):
    """Forwards the position that the provider follows."""

    MODES = WITH_ARDUINO

    arduino = needs(ArduinoProvider)
    location = needs(UpLocationProvider)

    _forwarded: Reading[LocationCommand] | None = None

    def load(self) -> bool:
        """Return whether the firmware is the thesis's: this project's has no use for it."""
        return bool(self.context.config(ARDUINO).framing == "thesis")

    def _execute_initialization(self) -> None:
        self._sender = ChangeSender(
            self.context.reactor, lambda payload: self.arduino.send_stream("l", payload)
        )
        self.arduino.add_board_listener(self._sender.forget)
        self.up.command_executor.register_command(LocationCommand, self.on_location)

    def _execute_stop(self) -> None:
        self._sender.stop()

    def on_location(self, command: LocationCommand) -> None:
        """Forward the provider's reading when it is a new one: it heard the Command before."""
        reading = self.location.reading
        if self.started and reading is not None and reading is not self._forwarded:
            self._forwarded = reading
            if reading.valid:
                place = reading.value
                self._sender.offer(pack_location(place.latitude_deg, place.longitude_deg))
