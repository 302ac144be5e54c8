"""The RC receiver: six channels at 50 Hz, moved by a script of sticks."""

from __future__ import annotations

import random
from dataclasses import dataclass

PERIOD_S = 0.02
CHANNELS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
SINGULAR = {"aileron": "ailerons"}
LOWEST_US, HIGHEST_US = 800, 2200

SOARING = "t=0 throttle=1000 aux1=2000 aux2=1000 t=1 aux2=2000"
POWERED = SOARING + " t=3 throttle=1700"


class SticksError(ValueError):
    """A stick script is wrong: the message is one sentence for the user."""


@dataclass(frozen=True, slots=True)
class StickMove:
    """At ``time_s`` the channel goes to ``value``: us, or for ``receiver`` 1 on and 0 off."""

    time_s: float
    channel: str
    value: int


def read_sticks(text: str) -> list[StickMove]:
    """Return the moves of a script such as ``t=5 aileron=1600 t=6 aileron=1500``.

    ``t=SECONDS`` since the start holds for the words after it. Channels take pulses of 800 to
    2200 us, ``receiver`` takes ``on`` or ``off``. Raises ``SticksError``.
    """
    time_s = 0.0
    moves: list[StickMove] = []
    for word in text.replace(",", " ").split():
        name, equals, value = word.partition("=")
        name = SINGULAR.get(name, name)
        if not equals:
            raise SticksError(f"sticks: {word!r} is not of the form name=value")
        if name == "t":
            time_s = _time_s(value, time_s)
        elif name == "receiver" and value in ("on", "off"):
            moves.append(StickMove(time_s, name, int(value == "on")))
        elif name in CHANNELS and value.isascii() and value.isdigit():
            if not LOWEST_US <= int(value) <= HIGHEST_US:
                raise SticksError(f"sticks: {word}: pulses are {LOWEST_US} to {HIGHEST_US} us")
            moves.append(StickMove(time_s, name, int(value)))
        else:
            known = ", ".join((*CHANNELS, "receiver=on|off"))
            raise SticksError(f"sticks: {word!r} is not understood (t, {known})")
    return moves


def _time_s(text: str, previous_s: float) -> float:
    try:
        time_s = float(text)
    except ValueError:
        raise SticksError(f"sticks: t={text} is not a number of seconds") from None
    if not previous_s <= time_s < 1e9:
        raise SticksError(f"sticks: t={text} does not come after t={previous_s:g}")
    return time_s


class Receiver:
    """What the board hears from the radio: pulses (us) with +-1 us of noise, at 50 Hz.

    ``pulses_us`` are the six channels in wire order, ``heard_s`` when they came. While the
    script has switched the receiver off no pulses come and the old ones stay.
    """

    def __init__(self, moves: list[StickMove], now_s: float, seed: int = 1) -> None:
        self._moves = sorted(moves, key=lambda move: move.time_s)
        self._sticks = dict(zip(CHANNELS, (1500, 1500, 1000, 1500, 1000, 1000), strict=True))
        self._is_on = True
        self._noise = random.Random(seed)
        self._start_s = now_s
        self._frames = -1
        self.heard_s: float | None = None
        self.pulses_us = tuple(self._sticks.values())

    def listen(self, now_s: float) -> bool:
        """Move the sticks up to now; true when a new set of pulses has come."""
        while self._moves and self._moves[0].time_s <= now_s - self._start_s + 1e-9:
            move = self._moves.pop(0)
            if move.channel == "receiver":
                self._is_on = bool(move.value)
            else:
                self._sticks[move.channel] = move.value
        frames = int((now_s - self._start_s) / PERIOD_S + 1e-6)
        if frames == self._frames:
            return False
        self._frames = frames
        if self._is_on:
            self.heard_s = now_s
            self.pulses_us = tuple(
                pulse + self._noise.randint(-1, 1) for pulse in self._sticks.values()
            )
        return self._is_on
