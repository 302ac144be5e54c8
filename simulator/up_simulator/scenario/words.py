"""Which words the signals have that are words."""

from __future__ import annotations

import difflib

from up.commands.board_schema import FLIGHT_MODES, RESET_CAUSES, SWITCH_MODES, SWITCH_POSITIONS

_MODES = tuple(FLIGHT_MODES.values())
_POSITIONS = tuple(SWITCH_POSITIONS.values())
_SOURCES = ("arduino", "android")
_CAUSES = tuple(RESET_CAUSES.values())
_WORDS: dict[str, tuple[str, ...]] = {
    "board.mode": _MODES,
    "board.switch": (*_POSITIONS, "not known"),
    "board.reset_cause": tuple(word for word in _CAUSES if " " not in word),
    "ground.arduino.framing": ("checked", "thesis"),
    "ground.arduino.switch": _POSITIONS,
    "ground.arduino.reset_cause": (*_CAUSES, "unknown"),
    "ground.mode": ("flight controller", "black box", "black box (provisional)"),
    "ground.flight_mode": _MODES,
    "ground.flight_controller": ("arduino", "raspberry"),
    "ground.flight_control.mode": tuple(SWITCH_MODES.values()),
}
_SEVERAL = {"board.reset_cause": " ", "ground.arduino.reset_cause": ", "}
"""Separators for signals that may have several values at a time."""


def words_of(name: str) -> tuple[str, ...]:
    """Return the words of a signal; empty where it may be any text."""
    return _SOURCES if name.startswith("ground.source.") else _WORDS.get(name, ())


def word_problem(name: str, text: str) -> str:
    """Return a sentence if the signal never has that value, with the probable intention."""
    words = words_of(name)
    parts = text.split(_SEVERAL[name]) if name in _SEVERAL else [text]
    wrong = next((part for part in parts if part not in words), None)
    if not words or wrong is None:
        return ""
    by_lower = {word.lower(): word for word in words}
    near = difflib.get_close_matches(wrong.lower()[:80], by_lower, n=1)
    hint = f"did you mean '{by_lower[near[0]]}'?" if near else f"it has {', '.join(words)}"
    return f'{name} is never "{wrong[:60]}": {hint}'
