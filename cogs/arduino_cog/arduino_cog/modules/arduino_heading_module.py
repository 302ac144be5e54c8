"""Headings on their way to the Arduino."""

from __future__ import annotations

from arduino_cog.change_sender import ChangeSender
from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import pack_heading
from up.base_started_module import BaseStartedModule
from up.commands.heading_command import HeadingCommand
from up.mode import WITH_ARDUINO
from up.needs import needs
from up.providers.reading import Reading
from up.providers.up_heading_provider import UpHeadingProvider


class ArduinoHeadingModule(BaseStartedModule):
    """Forwards the actual heading that the provider follows and the required one, whole degrees."""

    MODES = WITH_ARDUINO

    arduino = needs(ArduinoProvider)
    heading = needs(UpHeadingProvider)

    _forwarded: Reading[float] | None = None

    def _execute_initialization(self) -> None:
        clock, send = self.context.reactor, self.arduino.send_stream
        self._actual = ChangeSender(clock, lambda payload: send("b", payload))
        self._required = ChangeSender(clock, lambda payload: send("B", payload))
        self.arduino.add_board_listener(self.on_board_begun)
        self.up.command_executor.register_command(HeadingCommand, self.on_heading)

    def _execute_stop(self) -> None:
        self._actual.stop()
        self._required.stop()

    def on_heading(self, command: HeadingCommand) -> None:
        """Forward what the provider took of the Command: it heard it before."""
        if not self.started:
            return
        if command.mode == "required":
            self._forward_required()
            return
        reading = self.heading.reading
        if reading is not None and reading is not self._forwarded:
            self._forwarded = reading
            if reading.valid:
                self._actual.offer(pack_heading(reading.value))

    def on_board_begun(self) -> None:
        """Tell a board that may know nothing yet which heading is required."""
        self._actual.forget()
        self._required.forget()
        self._forward_required()

    def _forward_required(self) -> None:
        required_deg = self.heading.required_heading
        if required_deg is not None:
            self._required.offer(pack_heading(required_deg))
