"""Chooses the radio by the user's option; the radio that follows a script (``--sticks``)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from up_rig.sticks import BEFORE, StickMove, read_sticks
from up_simulator.aircraft.flight import FlightState
from up_simulator.harness.user_log import Log
from up_simulator.radio.axis_map import AxisMap
from up_simulator.radio.circling_pilot import CirclingPilot
from up_simulator.radio.game_controller import GameController, controller_device
from up_simulator.radio.keyboard_radio import KeyboardRadio
from up_simulator.radio.sticks import HIGHEST_US, SWITCH_US, Radio, Sticks

INITIAL_STICKS = Sticks(throttle=1500, aux1=SWITCH_US["FBW"], aux2=HIGHEST_US)
"""Initial sticks of a keyboard, in the air."""


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
        if self._pilot is not None:
            self._pilot.close()


def choose_radio(
    name: str,
    moves: list[StickMove],
    axis_map: AxisMap,
    *,
    has_motor: bool,
    log: Log,
    on_leave: Callable[[], None],
    mode: Callable[[], str] = lambda: "",
) -> Radio:
    """Return the radio of a name: circle, script, keyboard, or a game controller's device.

    ``moves`` is a script for the first two; ``on_leave`` is called when the keyboard's pilot
    leaves; ``mode`` returns the board's mode, or nothing. Raises ``RadioError``.
    """
    if name == "circle":
        pilot = CirclingPilot(has_motor=has_motor, mode=mode)
        return ScriptedRadio(moves, pilot)
    if name == "script":
        return ScriptedRadio([*read_sticks(BEFORE), *moves])
    if name == "keyboard":
        return KeyboardRadio(on_leave, start=INITIAL_STICKS, mode=mode)
    return GameController(controller_device(name), axis_map, log)


def is_initially_armed(name: str) -> bool:
    """Return whether such a pilot has armed before the flight begins in the air."""
    return name in ("circle", "keyboard")
