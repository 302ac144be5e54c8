"""Reads the stick scripts of the virtual aircraft's ``--sticks``."""

from __future__ import annotations

from dataclasses import dataclass

from up_rig.pins import CHANNELS

LOWEST_US, HIGHEST_US = 800, 2200
BEFORE = "t=0 throttle=1000 aux1=2000 aux2=1000 t=1 aux2=2000"
"""The state before the script: the switch at AUTO, the arming switch raised after a second."""
_SINGULAR = {"aileron": "ailerons"}


class SticksError(ValueError):
    """A script is wrong: the message is one sentence for the user."""


@dataclass(frozen=True, slots=True)
class StickMove:
    """At ``time_s`` the channel is set to ``value``: us, or for ``receiver`` 1 on and 0 off."""

    time_s: float
    channel: str
    value: int


def read_sticks(text: str) -> list[StickMove]:
    """Return the moves of a script such as ``t=5 aileron=1600 t=6 receiver=off``.

    ``t=SECONDS`` since the start holds for the words after it; pulses are 800 to 2200 us.
    Raises ``SticksError``.
    """
    time_s = 0.0
    moves: list[StickMove] = []
    for word in text.replace(",", " ").split():
        name, equals, value = word.partition("=")
        name = _SINGULAR.get(name, name)
        if not equals:
            raise SticksError(f"sticks: {word!r} is not of the form name=value")
        if name == "t":
            time_s = _later(value, time_s)
        elif name == "receiver" and value in ("on", "off"):
            moves.append(StickMove(time_s, name, int(value == "on")))
        elif name in CHANNELS:
            moves.append(StickMove(time_s, name, _pulse_us(word, value)))
        else:
            known = ", ".join((*CHANNELS, "receiver=on|off"))
            raise SticksError(f"sticks: {word!r} is not understood (t, {known})")
    return moves


def _pulse_us(word: str, value: str) -> int:
    is_number = value.isascii() and value.isdigit()
    if not is_number or not LOWEST_US <= int(value[:9]) <= HIGHEST_US:
        raise SticksError(f"sticks: {word}: pulses are {LOWEST_US} to {HIGHEST_US} us")
    return int(value)


def _later(text: str, previous_s: float) -> float:
    try:
        time_s = float(text)
    except ValueError:
        raise SticksError(f"sticks: t={text} is not a number of seconds") from None
    if not previous_s <= time_s < 1e9:
        raise SticksError(f"sticks: t={text} does not come after t={previous_s:g}")
    return time_s
