"""Arming and disarming by Command."""

from __future__ import annotations

from typing import Any

from twisted.internet.defer import Deferred

from arduino_cog.modules.arduino_provider import ArduinoProvider
from up.base_module import BaseModule
from up.commands.arming_commands import ArmCommand, DisarmCommand
from up.commands.refusal import CommandRefusedError
from up.mode import WITH_ARDUINO
from up.needs import needs


class ArduinoArming(BaseModule):
    """Passes `up.arm` and `up.disarm` to the Arduino and returns its answer.

    Refuses arming while this program has a veto, and names each.
    """

    MODES = WITH_ARDUINO

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
            raise CommandRefusedError(f"arming is vetoed: {named}")
        return self.arduino.request("a", may_repeat=False)

    def on_disarm(self, command: DisarmCommand) -> Deferred[Any]:
        """Disarm."""
        self.arduino.require_checked("disarming")
        return self.arduino.request("d")
