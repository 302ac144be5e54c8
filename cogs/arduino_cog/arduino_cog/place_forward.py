"""Sends a provider's readings to an Arduino with the thesis's firmware."""

from __future__ import annotations

from typing import Any

from serial_cog.config import ARDUINO

from arduino_cog.change_sender import ChangeSender
from arduino_cog.modules.arduino_provider import ArduinoProvider
from up.base_started_module import BaseStartedModule
from up.mode import WITH_ARDUINO
from up.needs import needs
from up.providers.base_provider import Reading


class PlaceForward(BaseStartedModule):
    """Forwards each new valid reading of ``source`` once, as the stream ``LETTER``.

    A subclass names the ``COMMAND`` that delivers readings, the provider as ``source``, and the
    packing of a value.
    """

    MODES = WITH_ARDUINO
    COMMAND: type[Any]
    LETTER: str

    arduino = needs(ArduinoProvider)
    source: Any

    _forwarded: Reading[Any] | None = None

    def load(self) -> bool:
        """Return whether the firmware is the thesis's: this project's does not use readings."""
        return bool(self.context.config(ARDUINO).framing == "thesis")

    def pack(self, value: Any) -> bytes:
        """Return a value as the payload of a message."""
        raise NotImplementedError

    def on_init(self) -> None:
        self._sender = ChangeSender(
            self.context.reactor, lambda payload: self.arduino.send_stream(self.LETTER, payload)
        )
        self.arduino.add_board_listener(self._sender.forget)
        self.up.command_executor.register_command(self.COMMAND, self.on_reading)

    def on_stop(self) -> None:
        self._sender.stop()

    def on_reading(self, command: Any) -> None:
        """Forward the provider's reading if it is new: the provider received the Command before."""
        reading = self.source.reading
        if self.started and reading is not None and reading is not self._forwarded:
            self._forwarded = reading
            if reading.valid:
                self._sender.offer(self.pack(reading.value))
