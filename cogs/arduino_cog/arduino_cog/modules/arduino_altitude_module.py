"""The altitude on its way to an Arduino with the thesis's firmware."""

from __future__ import annotations

from serial_cog.config import ARDUINO

from arduino_cog.change_sender import ChangeSender
from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import pack_altitude
from up.base_started_module import BaseStartedModule
from up.commands.altitude_command import AltitudeCommand
from up.mode import WITH_ARDUINO
from up.needs import needs
from up.providers.reading import Reading
from up.providers.up_altitude_provider import UpAltitudeProvider


class ArduinoAltitudeModule(BaseStartedModule):
    """Forwards the altitude that the provider follows, in whole metres."""

    MODES = WITH_ARDUINO

    arduino = needs(ArduinoProvider)
    altitude = needs(UpAltitudeProvider)

    _forwarded: Reading[float] | None = None

    def load(self) -> bool:
        """Return whether the firmware is the thesis's: this project's has no use for it."""
        return bool(self.context.config(ARDUINO).framing == "thesis")

    def _execute_initialization(self) -> None:
        self._sender = ChangeSender(
            self.context.reactor, lambda payload: self.arduino.send_stream("h", payload)
        )
        self.arduino.add_board_listener(self._sender.forget)
        self.up.command_executor.register_command(AltitudeCommand, self.on_altitude)

    def _execute_stop(self) -> None:
        self._sender.stop()

    def on_altitude(self, command: AltitudeCommand) -> None:
        """Forward the provider's reading when it is a new one: it heard the Command before."""
        reading = self.altitude.reading
        if self.started and reading is not None and reading is not self._forwarded:
            self._forwarded = reading
            if reading.valid:
                self._sender.offer(pack_altitude(reading.value))
