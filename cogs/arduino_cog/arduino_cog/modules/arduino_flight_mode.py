"""The flight mode that the ground requests."""

from __future__ import annotations

from typing import Any

from twisted.internet.defer import Deferred

from arduino_cog.modules.arduino_provider import ArduinoProvider
from up.base_module import BaseModule
from up.commands.flight_state_command import FlightModeCommand
from up.mode import WITH_ARDUINO
from up.needs import needs

_LETTERS = {"RATE": b"r", "FBW": b"f"}
_AUTO = {"arduino": b"s", "raspberry": b"u"}
"""The mode for AUTO: setpoints of the Raspberry Pi, or servo outputs where it controls."""


class ArduinoFlightMode(BaseModule):
    """Passes `up.flight_mode.set` to the Arduino, which accepts it only with the switch at AUTO."""

    MODES = WITH_ARDUINO

    arduino = needs(ArduinoProvider)

    def on_init(self) -> None:
        auto = _AUTO[self.context.application.flight_controller]
        self._letters = {**_LETTERS, "AUTO": auto}
        self.up.command_executor.register_command(FlightModeCommand, self.on_flight_mode)

    def on_flight_mode(self, command: FlightModeCommand) -> Deferred[Any]:
        """Request the mode; ACRO has no letter, as the ground can never select it."""
        self.arduino.require_checked("a flight mode")
        return self.arduino.request("M", self._letters[command.mode])
