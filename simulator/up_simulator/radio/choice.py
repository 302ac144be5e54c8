"""Chooses the radio by the user's option."""

from __future__ import annotations

from collections.abc import Callable

from up_rig.sticks import BEFORE, StickMove, read_sticks
from up_simulator.radio.axis_map import AxisMap
from up_simulator.radio.circling_pilot import CirclingPilot
from up_simulator.radio.game_controller import GameController, controller_device
from up_simulator.radio.keyboard_radio import KeyboardRadio
from up_simulator.radio.scripted import ScriptedRadio
from up_simulator.radio.sticks import HIGHEST_US, SWITCH_US, Radio, Sticks

AT_FIRST = Sticks(throttle=1500, aux1=SWITCH_US["FBW"], aux2=HIGHEST_US)
"""Initial sticks of a keyboard, in the air."""


def choose_radio(
    name: str,
    moves: list[StickMove],
    axis_map: AxisMap,
    *,
    has_motor: bool,
    is_armed: bool,
    say: Callable[[str], None],
    on_leave: Callable[[], None],
    mode: Callable[[], str] = lambda: "",
) -> Radio:
    """Return the radio of a name: circle, script, keyboard, or a game controller's device.

    ``moves`` is a script for the first two; ``is_armed`` returns whether the board is armed before
    the flight, if ``is_armed_at_first`` requires it; ``on_leave`` is called when the keyboard's
    pilot leaves; ``mode`` returns the board's mode, or nothing. Raises ``RadioError``.
    """
    if name == "circle":
        pilot = CirclingPilot(has_motor=has_motor, is_armed=is_armed, mode=mode)
        return ScriptedRadio(moves, pilot)
    if name == "script":
        return ScriptedRadio([*read_sticks(BEFORE), *moves])
    if name == "keyboard":
        return KeyboardRadio(on_leave, start=AT_FIRST, mode=mode)
    return GameController(controller_device(name), axis_map, say)


def is_armed_at_first(name: str) -> bool:
    """Return whether such a pilot has armed before the flight begins in the air."""
    return name in ("circle", "keyboard")
