"""Forwards Panic Mode to the Arduino (thesis 3.2.5)."""

from twisted.python.failure import Failure

from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import pack_panic
from up.base_module import BaseModule
from up.commands.panic_command import PanicCommand
from up.commands.refusal import CommandRefusedError
from up.mode import WITH_BOARD
from up.needs import needs


class ArduinoPanic(BaseModule):
    """Sends the Arduino its forwarding period, on every change and after its reset."""

    MODES = WITH_BOARD

    arduino = needs(ArduinoProvider)

    _newest: PanicCommand | None = None

    def on_init(self) -> None:
        self.up.command_executor.register_command(PanicCommand, self.on_panic)
        self.arduino.add_board_listener(self.on_board_started)

    def on_panic(self, command: PanicCommand) -> None:
        """Forward it; an absent Arduino receives it when it connects."""
        self._newest = command
        if self.arduino.connected:
            self._forward(command)

    def on_board_started(self) -> None:
        """Send the period to a new or reset board during panic."""
        if self._newest is not None and self._newest.panic:
            self._forward(self._newest)

    def _forward(self, command: PanicCommand) -> None:
        payload = pack_panic(command.panic, command.delay_ms)
        if self.arduino.is_checked:
            self.arduino.request("p", payload).addErrback(self._on_refused)
        else:
            self.arduino.serial.send_command("p", payload)

    def _on_refused(self, failure: Failure) -> None:
        failure.trap(CommandRefusedError)
        self.log.warn(
            "panic was not passed on: {reason}",
            code="panic_refused",
            reason=failure.getErrorMessage(),
        )
