"""Positions of the pilot's sticks and switches over time."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from up.config import key
from up_rig.sticks import HIGHEST_US, LOWEST_US

CHANNELS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
ARMED_US, DISARMED_US = 2000.0, 1000.0
SWITCH_US = {"low": 1000.0, "middle": 1500.0, "high": 2000.0}
INITIAL_US = {
    "ailerons": 1500.0,
    "elevator": 1500.0,
    "throttle": 1000.0,
    "rudder": 1500.0,
    "aux1": 1000.0,
    "aux2": 1000.0,
}


def _deflection(comment: str) -> float | None:
    return key(None, comment, minimum=-1, maximum=1)


def _pulse() -> float | None:
    return key(
        None,
        "The same as a pulse width.",
        unit="us",
        minimum=float(LOWEST_US),
        maximum=float(HIGHEST_US),
    )


@dataclass(frozen=True, slots=True)
class StickPoint:
    """A move of sticks or switches; others keep their position."""

    at_s: float = key(
        0.0, "Time; 0 is the start of the flight.", unit="s", minimum=-10, maximum=3600
    )
    over_s: float = key(
        0.0,
        "Duration of the move, at constant speed. 0: immediate.",
        unit="s",
        minimum=0,
        maximum=600,
    )
    ailerons: float | None = _deflection("-1 is full left, 1 full right (right wing down).")
    elevator: float | None = _deflection("-1 is full forward, 1 fully pulled (nose up).")
    throttle: float | None = key(None, "0 is idle, 1 full throttle.", minimum=0, maximum=1)
    rudder: float | None = _deflection("-1 is full left, 1 full right.")
    mode: Literal["ACRO", "RATE", "FBW", "AUTO"] | None = key(
        None,
        "The mode switch (AUX1) goes to the position that selects this mode.",
        ignore_case=True,
    )
    arm: bool | None = key(None, "The arming switch (AUX2): true is up.")
    ailerons_us: float | None = _pulse()
    elevator_us: float | None = _pulse()
    throttle_us: float | None = _pulse()
    rudder_us: float | None = _pulse()
    aux1_us: float | None = _pulse()
    aux2_us: float | None = _pulse()

    def problems(self) -> Iterator[tuple[str, str]]:
        others = {"aux1": "mode", "aux2": "arm"}
        for channel in CHANNELS:
            other = others.get(channel, channel)
            pulse = f"{channel}_us"
            if getattr(self, other) is not None and getattr(self, pulse) is not None:
                yield pulse, f"contradicts '{other}': remove one of them"
        if all(getattr(self, name) is None for name in self.__slots__ if name not in _WHEN):
            yield "at_s", "contains no move: set a stick, 'mode' or 'arm'"

    def pulses_us(self, switch: dict[str, str]) -> Iterator[tuple[str, float]]:
        """Yield channel and pulse of its moves; ``switch`` gives each position its mode.

        Raises KeyError for a mode that no position selects.
        """
        for channel in ("ailerons", "elevator", "rudder"):
            if (share := getattr(self, channel)) is not None:
                yield channel, 1500.0 + 500.0 * share
        if self.throttle is not None:
            yield "throttle", 1000.0 + 1000.0 * self.throttle
        if self.mode is not None:
            yield "aux1", switch_us(self.mode, switch)
        if self.arm is not None:
            yield "aux2", ARMED_US if self.arm else DISARMED_US
        for channel in CHANNELS:
            if (pulse_us := getattr(self, f"{channel}_us")) is not None:
                yield channel, pulse_us


_WHEN = ("at_s", "over_s")


def switch_us(mode: str, switch: dict[str, str]) -> float:
    """Return the pulse of AUX1 for a mode; raises KeyError where no position selects it."""
    for position, selected in switch.items():
        if selected == mode:
            return SWITCH_US[position]
    raise KeyError(mode)


@dataclass(slots=True)
class _Move:
    begin_s: float
    end_s: float
    before_us: float
    after_us: float

    def at_us(self, time_s: float) -> float:
        if time_s >= self.end_s:
            return self.after_us
        share = (time_s - self.begin_s) / (self.end_s - self.begin_s)
        return self.before_us + share * (self.after_us - self.before_us)


class StickTimeline:
    """The pulses of all channels at any time, made from points in any order.

    A move that begins during another one starts from the stick's position at that time.
    """

    def __init__(self, points: tuple[StickPoint, ...], switch: dict[str, str]) -> None:
        self._moves: dict[str, list[_Move]] = {channel: [] for channel in CHANNELS}
        for point in sorted(points, key=lambda point: point.at_s):
            for channel, pulse_us in point.pulses_us(switch):
                before_us = self.pulse_us(channel, point.at_s)
                move = _Move(point.at_s, point.at_s + point.over_s, before_us, pulse_us)
                self._moves[channel].append(move)

    def pulse_us(self, channel: str, time_s: float) -> float:
        for move in reversed(self._moves[channel]):
            if time_s >= move.begin_s - 1e-9:
                return move.at_us(time_s)
        return INITIAL_US[channel]

    def still_until_s(self, time_s: float) -> float:
        """Return when a pulse changes next after ``time_s``: that time itself if one is moving."""
        next_s = math.inf
        for moves in self._moves.values():
            for move in moves:
                begin_s = move.begin_s - 1e-9
                if begin_s > time_s:
                    next_s = min(next_s, begin_s)
                elif move.end_s > time_s:
                    return time_s
        return next_s

    def pulses_us(self, time_s: float) -> dict[str, float]:
        return {channel: self.pulse_us(channel, time_s) for channel in CHANNELS}
