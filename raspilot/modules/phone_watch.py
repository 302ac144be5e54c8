"""Tells the runner whether the phone of this instance is connected, and whether it is armed."""

from up.base_started_module import BaseStartedModule
from up.commands.flight_state_command import FlightStateCommand
from up.commands.system_commands import LinkStateCommand
from up.system.clock import Timer, cancel
from up.system.notify import Notifier

PHONE_LINK = "android"
REPEAT_S = 2.0


class PhoneWatch(BaseStartedModule):
    """Loaded only if a runner started the instance; repeats the report for a new runner.

    Without a board, as in Black Box Mode, nothing can be armed (docs/runner.md).
    """

    def load(self) -> bool:
        return bool(self.context.instance)

    def on_init(self) -> None:
        self.notifier = Notifier.from_environment()
        self._is_connected = False
        self._is_armed = False
        self._timer: Timer | None = None
        self.up.command_executor.register_command(LinkStateCommand, self._on_link)
        self.up.command_executor.register_command(FlightStateCommand, self._on_flight_state)

    def on_start(self) -> bool:
        self._repeat()
        return True

    def on_stop(self) -> None:
        cancel(self._timer)

    def _on_link(self, command: LinkStateCommand) -> None:
        if command.link == PHONE_LINK:
            self._is_connected = command.connected
            self._report()

    def _on_flight_state(self, command: FlightStateCommand) -> None:
        """Count an aircraft that may be in flight as armed."""
        is_armed = command.is_armed or command.is_in_flight is not False
        if is_armed != self._is_armed:
            self._is_armed = is_armed
            self._report()

    def _repeat(self) -> None:
        self._timer = self.context.reactor.callLater(REPEAT_S, self._repeat)
        self._report()

    def _report(self) -> None:
        self.notifier.variable("X_UP_PHONE", "1" if self._is_connected else "0")
        self.notifier.variable("X_UP_ARMED", "1" if self._is_armed else "0")
