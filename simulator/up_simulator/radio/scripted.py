"""A radio that follows a script (``--sticks``)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from up_rig.sticks import StickMove
from up_simulator.aircraft.flight import FlightState
from up_simulator.radio.sticks import Radio, Sticks


class ScriptedRadio:
    """Moves sticks at the times of a script; between them they stay.

    With a ``pilot`` the script overrides that pilot: a channel that the script has named follows
    the script from then on.
    """

    def __init__(self, moves: list[StickMove], pilot: Radio | None = None) -> None:
        self._moves = sorted(moves, key=lambda move: move.time_s)
        self._pilot = pilot
        self._held: dict[str, int] = {}
        self._is_on = True

    def sticks(self, time_s: float, state: FlightState) -> Sticks:
        """Return the sticks of the script at this time."""
        while self._moves and self._moves[0].time_s <= time_s:
            move = self._moves.pop(0)
            if move.channel == "receiver":
                self._is_on = bool(move.value)
            else:
                self._held[move.channel] = move.value
        sticks = Sticks() if self._pilot is None else self._pilot.sticks(time_s, state)
        held: dict[str, Any] = {**self._held, "is_on": sticks.is_on and self._is_on}
        return replace(sticks, **held)

    def close(self) -> None:
        """Close the pilot, too."""
        if self._pilot is not None:
            self._pilot.close()
