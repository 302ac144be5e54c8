"""Publishes and keeps the state of the system (thesis 3.3.5)."""

from collections.abc import Mapping
from typing import Any

from load_guard_cog.modules.load_guard import LoadGuard
from up.base_started_module import BaseStartedModule
from up.commands.roles import Role
from up.commands.system_commands import LinkStateCommand, SystemStateCommand
from up.mode_monitor import ModeMonitor
from up.needs import needs, wants
from up.providers.base_mission_control_provider import BaseMissionControlProvider
from up.providers.base_provider import BaseProvider
from up.system.clock import Timer, cancel

PERIOD_S = 1.0


class SystemStateProvider(BaseStartedModule):
    """Publishes a SystemStateCommand every second; reports a changed kind of state to the ground.

    A newer state from another publisher (for example a companion computer) is accepted: telemetry
    shows the newest Command, not this module's own view.
    """

    load_guard = needs(LoadGuard)
    mode_monitor = needs(ModeMonitor)
    mission_control = wants(BaseMissionControlProvider)

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        return {"system": {"providers": None if self.state is None else self.state.providers}}

    def on_init(self) -> None:
        self.state: SystemStateCommand | None = None
        self._is_board_connected = False
        self._reported: tuple[Any, ...] = ()
        self._timer: Timer | None = None
        executor = self.up.command_executor
        executor.register_command(LinkStateCommand, self._on_link)
        executor.register_command(SystemStateCommand, self._on_state)

    def on_start(self) -> bool:
        self._publish()
        return True

    def on_stop(self) -> None:
        cancel(self._timer)

    def _on_link(self, command: LinkStateCommand) -> None:
        if self.up.command_executor.origin.role is Role.BOARD:
            self._is_board_connected = command.connected

    def _on_state(self, command: SystemStateCommand) -> None:
        self.state = command
        kind = (command.providers, command.arduino_connected, command.mode)
        if kind != self._reported and self.mission_control is not None:
            self._reported = kind
            self.mission_control.send_command(command)

    def _publish(self) -> None:
        self._timer = self.context.reactor.callLater(PERIOD_S, self._publish)
        self.up.command_executor.execute_command(
            SystemStateCommand(
                utilization_percent=self.load_guard.cpu_utilization,
                memory_percent=self.load_guard.ram,
                providers=self._present_providers(),
                arduino_connected=self._is_board_connected,
                mode=self.mode_monitor.shown,
            )
        )

    def _present_providers(self) -> tuple[str, ...]:
        return tuple(
            sorted(
                provider.READING
                for provider in self.up.get_modules(BaseProvider)
                if provider.fresh(provider.MAX_AGE_S) is not None
            )
        )
