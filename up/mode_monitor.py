"""The mode of the system, as telemetry shows it (thesis 2.4.7, 4.1.3)."""

from collections.abc import Mapping
from typing import Any

from up.base_started_module import BaseStartedModule
from up.commands.roles import Role
from up.commands.system_commands import LinkStateCommand
from up.mode import Mode
from up.system.clock import Timer

BOARD_TIMEOUT_S = 5.0


class ModeMonitor(BaseStartedModule):
    """Reports Black Box Mode provisionally while no frame of the board arrives, in mode ``auto``.

    Flight Controller Mode returns automatically when the board answers. Any other configured
    mode is constant.
    """

    @property
    def shown(self) -> str:
        if self.context.mode is Mode.BLACK_BOX:
            return Mode.BLACK_BOX.value
        if self.is_provisional:
            return f"{Mode.BLACK_BOX.value} (provisional)"
        return Mode.FLIGHT_CONTROLLER.value

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        controller = self.context.application.flight_controller
        return {
            "mode": self.shown,
            "flight_controller": controller if self.context.mode.may_control else None,
        }

    def on_init(self) -> None:
        self.is_provisional = False
        self._is_over = False
        self._timer: Timer | None = None
        if self.context.mode is Mode.AUTO:
            self.up.command_executor.register_command(LinkStateCommand, self._on_link)

    def on_start(self) -> bool:
        if self.context.mode is Mode.AUTO:
            self._wait()
        return True

    def on_stop(self) -> None:
        self._is_over = True
        self._cancel_timer()

    def _on_link(self, command: LinkStateCommand) -> None:
        if self.up.command_executor.origin.role is not Role.BOARD:
            return
        if not command.connected:
            self._wait()
            return
        self._cancel_timer()
        if self.is_provisional:
            self.is_provisional = False
            self.log.warn("the board answers: back in Flight Controller Mode", code="mode_restored")

    def _wait(self) -> None:
        if self._timer is None and not self.is_provisional and not self._is_over:
            self._timer = self.context.reactor.callLater(BOARD_TIMEOUT_S, self._give_up)

    def _cancel_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _give_up(self) -> None:
        self._timer = None
        self.is_provisional = True
        self.log.error(
            "no frame from the board for {patience_s:.0f} s: provisionally in Black Box Mode;"
            " nothing is controlled from here",
            patience_s=BOARD_TIMEOUT_S,
            code="mode_provisional",
        )
