"""Passes Commands of the ground to the Arduino: arming, flight mode, calibration."""

from typing import Any

from twisted.internet.defer import Deferred

from arduino_cog.commands.arduino_commands import (
    CALIBRATIONS,
    ArduinoCalibrateCommand,
    BatteryCalibrateCommand,
)
from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import IN_FLIGHT, pack_voltage
from up.base_module import BaseModule
from up.commands.arming_commands import ArmCommand, DisarmCommand
from up.commands.flight_state_command import FlightModeCommand
from up.commands.refusal import Code, CommandRefusedError
from up.fields import suggestion
from up.mode import WITH_BOARD
from up.needs import needs

_LETTERS = {"RATE": b"r", "FBW": b"f"}
_AUTO = {"arduino": b"s", "raspberry": b"u"}
"""The mode for AUTO: setpoints of the Raspberry Pi, or servo outputs where it controls."""
_END = "receiver_end"


class ArduinoArming(BaseModule):
    """Passes `up.arm` and `up.disarm` to the Arduino and returns its answer.

    Refuses arming while this program has a veto, and names each.
    """

    MODES = WITH_BOARD

    arduino = needs(ArduinoProvider)

    def on_init(self) -> None:
        self.up.command_executor.register_command(ArmCommand, self.on_arm)
        self.up.command_executor.register_command(DisarmCommand, self.on_disarm)

    def on_arm(self, command: ArmCommand) -> Deferred[Any]:
        """Arm; never repeated: a late repetition must not arm after a disarm."""
        self.arduino.require_checked("arming")
        vetoes = self.up.vetoes.own
        if vetoes:
            named = "; ".join(f"{name}: {reason}" for name, reason in vetoes.items())
            raise CommandRefusedError(f"arming is vetoed: {named}", detail="veto")
        return self.arduino.request("a", may_repeat=False)

    def on_disarm(self, command: DisarmCommand) -> Deferred[Any]:
        self.arduino.require_checked("disarming")
        return self.arduino.request("d")


class ArduinoFlightMode(BaseModule):
    """Passes `up.flight_mode.set` to the Arduino, which accepts it only with the switch at AUTO."""

    MODES = WITH_BOARD

    arduino = needs(ArduinoProvider)

    def on_init(self) -> None:
        auto = _AUTO[self.context.application.flight_controller]
        self._letters = {**_LETTERS, "AUTO": auto}
        self.up.command_executor.register_command(FlightModeCommand, self.on_flight_mode)

    def on_flight_mode(self, command: FlightModeCommand) -> Deferred[Any] | None:
        """Request the mode; ACRO has no letter, as the ground can never select it.

        Other modes are those of the flight controller on this computer.
        """
        self.arduino.require_checked("a flight mode")
        letter = self._letters.get(command.mode)
        if letter is not None:
            return self.arduino.request("M", letter)
        control = self.up.flight_control
        if control is None or not control.SELECTS_MODES:
            near = suggestion(command.mode, self._letters)
            raise CommandRefusedError(
                f"no flight mode {command.mode}{near}", Code.INVALID, detail="mode_unknown"
            )
        return None


class ArduinoCalibration(BaseModule):
    """Passes `arduino.calibrate` and `up.battery.calibrate` to the Arduino, but not in flight.

    The end of the receiver calibration is always passed on: it began on the ground.
    """

    MODES = WITH_BOARD

    arduino = needs(ArduinoProvider)

    def on_init(self) -> None:
        self.up.command_executor.register_command(ArduinoCalibrateCommand, self.on_calibrate)
        self.up.command_executor.register_command(BatteryCalibrateCommand, self.on_battery)

    def on_calibrate(self, command: ArduinoCalibrateCommand) -> Deferred[Any]:
        """Calibrate; the end of the receiver calibration is not repeated, as a second one fails."""
        self._require(may_fly=command.what == _END)
        payload = bytes((CALIBRATIONS[command.what],))
        done = self.arduino.request("e", payload, may_repeat=command.what != _END)
        return done.addCallback(self._log_calibrated, command.what)

    def on_battery(self, command: BatteryCalibrateCommand) -> Deferred[Any]:
        """Calibrate the flight battery's voltage."""
        self._require()
        done = self.arduino.request("V", pack_voltage(command.voltage))
        return done.addCallback(self._log_calibrated, f"flight battery, {command.voltage:g} V")

    def _require(self, *, may_fly: bool = False) -> None:
        self.arduino.require_checked("calibrating")
        if not may_fly and self.arduino.is_in_flight:
            raise CommandRefusedError(
                f"calibration is refused in flight; {IN_FLIGHT}", detail="in_flight"
            )

    def _log_calibrated(self, _: object, what: str) -> None:
        self.log.info("the Arduino calibrated: {what}", code="calibrated", what=what)
