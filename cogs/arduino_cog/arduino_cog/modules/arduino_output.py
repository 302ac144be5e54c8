"""Sends Outputs and setpoints to the Arduino."""

from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import OUTPUT, pack_setpoint
from up.base_module import BaseModule
from up.commands.output_command import OutputCommand, SetpointCommand
from up.mode import WITH_BOARD
from up.needs import needs

_pack_output = OUTPUT.pack


class ArduinoOutput(BaseModule):
    """Sends `up.output.set` as `u`, `up.setpoint.set` as `S` or `R`; never in thesis framing.

    An Output that is still unsent is replaced by the next one: an old one is worthless.
    """

    MODES = WITH_BOARD

    arduino = needs(ArduinoProvider)

    def on_init(self) -> None:
        self._send_command = self.arduino.serial.send_command
        if not self.arduino.is_checked:
            self.log.info(
                "thesis framing: the Raspberry Pi's Outputs and setpoints are not sent",
                code="outputs_not_supported",
            )
            return
        self.up.command_executor.register_command(OutputCommand, self.on_output)
        self.up.command_executor.register_command(SetpointCommand, self.on_setpoint)

    def on_output(self, command: OutputCommand) -> None:
        """Send servo positions; struct.error for values that do not fit."""
        self._send_command(
            0x75,
            _pack_output(
                command.ailerons_us,
                command.elevator_us,
                command.throttle_us,
                command.rudder_us,
                command.sequence,
            ),
            True,
        )

    def on_setpoint(self, command: SetpointCommand) -> None:
        """Send an attitude; ValueError for values out of range."""
        payload = pack_setpoint(
            command.roll_deg,
            command.pitch_deg,
            command.yaw_rate_deg_s,
            command.throttle_us,
            command.lifetime_ms,
        )
        self._send_command("R" if command.is_failsafe else "S", payload, True)
