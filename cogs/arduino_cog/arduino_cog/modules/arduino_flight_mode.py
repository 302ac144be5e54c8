"""The flight mode that the ground asks for."""

from __future__ import annotations

from typing import Any

from twisted.internet.defer import Deferred

from arduino_cog.modules.arduino_provider import ArduinoProvider
from up.base_module import BaseModule
from up.commands.flight_mode_command import FlightModeCommand
from up.mode import WITH_ARDUINO
from up.needs import needs

_LETTERS = {"RATE": b"r", "FBW": b"f"}
_AUTO = {"arduino": b"s", "raspberry": b"u"}
"""What AUTO is: attitude asked by the Raspberry Pi, or servo positions where it controls."""


class ArduinoFlightMode(BaseModule):
    """Passes `up.flight_mode.set` to the Arduino, which takes it with the switch at AUTO only."""

    MODES = WITH_ARDUINO

    arduino = needs(ArduinoProvider)

    def _execute_initialization(self) -> None:
        auto = _AUTO[self.context.application.flight_controller]
        self._letters = {**_LETTERS, "AUTO": auto}
        self.up.command_executor.register_command(FlightModeCommand, self.on_flight_mode)

    def on_flight_mode(self, command: FlightModeCommand) -> Deferred[Any]:
        """Ask for the mode; there is no letter for ACRO, which the ground can never select."""
        self.arduino.require_checked("a flight mode")
        return self.arduino.request("M", self._letters[command.mode])
