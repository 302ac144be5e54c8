"""The RC receiver: six channels at 50 Hz, moved by a script of sticks."""

from __future__ import annotations

import random

from up_rig.pins import CHANNELS
from up_rig.sticks import StickMove, SticksError, read_sticks

__all__ = ["POWERED", "SOARING", "Receiver", "StickMove", "SticksError", "read_sticks"]

PERIOD_S = 0.02
SOARING = "t=0 throttle=1000 aux1=2000 aux2=1000 t=1 aux2=2000"
POWERED = SOARING + " t=3 throttle=1450"


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

    def set_stick(self, channel: str, width_us: float) -> None:
        """Move a stick by hand."""
        self._sticks[channel] = round(width_us)

    def set_receiver(self, is_on: bool) -> None:
        """Switch the receiver on or off by hand."""
        self._is_on = is_on

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
