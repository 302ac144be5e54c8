"""When the ground may set gains."""

from __future__ import annotations

from up.commands.command import BaseCommand
from up.commands.flight_state_command import FlightStateCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand

KEY = "mission_control.yml: tune_in_flight"


class TuningPolicy:
    """Refuses gains in flight unless the configuration accepts them.

    In flight is armed, or the switch at AUTO: a glider without a motor is never armed.
    """

    def __init__(self, tunes_in_flight: bool) -> None:
        self._tunes_in_flight = tunes_in_flight
        self._is_in_flight = False

    def on_flight_state(self, command: FlightStateCommand) -> None:
        """Take what the board says."""
        self._is_in_flight = command.is_armed or command.is_auto

    def __call__(self, command: BaseCommand) -> str | None:
        """Return why a Command is refused, or None."""
        if not isinstance(command, PIDTuningsCommand) or command.gains is None:
            return None
        if self._tunes_in_flight or not self._is_in_flight:
            return None
        return f"gains are not set while armed or at AUTO ({KEY})"
