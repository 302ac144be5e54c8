"""Decides when the ground may set gains."""

from up.commands.command import BaseCommand
from up.commands.flight_state_command import FlightStateCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand

KEY = "mission_control.yml: tune_in_flight"


class TuningPolicy:
    """Refuses gains in flight and at AUTO unless the configuration accepts them.

    The board's link reports whether it is in flight; without a report it counts as in flight.
    """

    def __init__(self, tunes_in_flight: bool) -> None:
        self._tunes_in_flight = tunes_in_flight
        self._is_in_flight = False

    def on_flight_state(self, command: FlightStateCommand) -> None:
        self._is_in_flight = command.is_in_flight is not False or command.is_auto

    def __call__(self, command: BaseCommand) -> str | None:
        if not isinstance(command, PIDTuningsCommand) or command.gains is None:
            return None
        if self._tunes_in_flight or not self._is_in_flight:
            return None
        return (
            "gains are not set while armed or at AUTO, nor without a motor once the receiver was"
            f" heard since power-on ({KEY})"
        )
