"""Calibrating the Arduino by Command."""

from __future__ import annotations

from typing import Any

from twisted.internet.defer import Deferred

from arduino_cog.commands.arduino_calibrate_command import CALIBRATIONS, ArduinoCalibrateCommand
from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import IN_FLIGHT
from up.base_module import BaseModule
from up.commands.refusal import CommandRefusedError
from up.mode import WITH_ARDUINO
from up.needs import needs

_END = "receiver_end"


class ArduinoCalibration(BaseModule):
    """Passes `arduino.calibrate` to the Arduino, unless the aircraft may be in flight.

    The end of the receiver calibration is always passed on: it began on the ground.
    """

    MODES = WITH_ARDUINO

    arduino = needs(ArduinoProvider)

    def on_init(self) -> None:
        self.up.command_executor.register_command(ArduinoCalibrateCommand, self.on_calibrate)

    def on_calibrate(self, command: ArduinoCalibrateCommand) -> Deferred[Any]:
        """Calibrate; the end of the receiver calibration is not repeated, as a second one fails."""
        self.arduino.require_checked("calibrating")
        if command.what != _END and self.arduino.is_in_flight:
            raise CommandRefusedError(f"calibrating is not for the air: {IN_FLIGHT}")
        payload = bytes((CALIBRATIONS[command.what],))
        done = self.arduino.request("e", payload, may_repeat=command.what != _END)
        return done.addCallback(self._say, command.what)

    def _say(self, _: object, what: str) -> None:
        self.log.info("the Arduino calibrated: {what}", what=what)
