"""What the board lets the Raspberry Pi do, and the request that it may fly."""

from typing import Any

from twisted.logger import Logger

from up.commands.command_executor import CommandExecutor
from up.commands.flight_state_command import FlightModeCommand, FlightStateCommand
from up.commands.origin import Origin
from up.flight_modes.declarations import AUTO

REQUEST_PERIOD_S = 5.0
FAILSAFE_MODE = "RETURN"
"""The board's mode while it follows set-points in receiver failsafe."""
_NOT_PERMITTED = "does not fly: the board does not let it"


class BoardAuthority:
    """The newest state of the board, for the one module that publishes set-points or Outputs.

    With ``is_output`` that module's control loop moves the servos. ``origin`` is the module's.
    """

    def __init__(
        self, executor: CommandExecutor, reactor: Any, origin: Origin, log: Logger, is_output: bool
    ) -> None:
        self.state: FlightStateCommand | None = None
        self._executor = executor
        self._reactor = reactor
        self._origin = origin
        self._log = log
        self._is_output = is_output
        self._followed_modes = ("OUTPUT" if is_output else "SETPOINT", FAILSAFE_MODE)
        self._asked_at_s = float("-inf")
        self._logged = _NOT_PERMITTED

    @property
    def is_auto(self) -> bool:
        return self.state is not None and self.state.is_auto

    @property
    def is_failsafe(self) -> bool:
        return self.state is not None and self.state.is_failsafe

    @property
    def is_followed(self) -> bool:
        """Return whether the board follows Commands of the Raspberry Pi now."""
        return self.state is not None and self.state.flight_mode in self._followed_modes

    @property
    def may_publish(self) -> bool:
        """Return whether the board may follow: it waits for set-points, and asks for Outputs."""
        state = self.state
        if state is None or state.is_failsafe:
            return state is not None
        return state.flight_mode in self._followed_modes if self._is_output else state.is_auto

    @property
    def is_flown(self) -> bool:
        """Return whether the board follows this module: another one may have control."""
        return self.is_followed and self._executor.control.owner == self._origin.link

    def log_change(self) -> None:
        """Log whether the module flies, if that is news."""
        owner = self._executor.control.owner
        if not self.is_followed:
            text = _NOT_PERMITTED
        elif self.is_flown:
            text = "flies"
        else:
            text = f"does not fly: {owner or 'no module'} has control"
        if text != self._logged:
            self._logged = text
            self._log.info(
                "{text}",
                text=text,
                code="control_changed",
                flies=self.is_flown,
                permitted=self.is_followed,
                owner=owner,
            )

    def request(self, at_once: bool) -> None:
        """Request AUTO from the board: after a state change, and periodically in case of loss."""
        now_s = self._reactor.seconds()
        if at_once or now_s - self._asked_at_s >= REQUEST_PERIOD_S:
            self._asked_at_s = now_s
            self._executor.execute_command(FlightModeCommand(AUTO), self._origin)
