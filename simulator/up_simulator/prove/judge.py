"""Judges a flight by its track: no Twisted, no simulator."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

FOLLOWED = ("SETPOINT", "OUTPUT", "RETURN")
"""Modes of the board in which it follows the Raspberry Pi."""
STALL_MARGIN, SLOW_S = 1.05, 0.3
"""It is slow below this times its stall speed, for this time: a gust of turbulence is shorter."""
FARTHER_M = 100.0
FLOOR_M = 10.0
"""So high above the floor the estimate, which has an error, is surely above it."""
GROUND_M = 0.2
"""Below it the aircraft has landed."""
WARN = "warn"
CODES = (
    "refused", "no_reaction", "stall", "outside", "above_ceiling", "below_floor", "fly_away",
    "crash", "failed",
)  # fmt: skip
"""What may be wrong, causes before their effects."""
Found = tuple[tuple[str, float], ...]


@dataclass(frozen=True, slots=True)
class Sample:
    """The truth, and what flies; positions from home, m. ``active``: the failsafes that hold."""

    time_s: float
    north_m: float
    east_m: float
    height_m: float
    airspeed_m_s: float
    mode: str | None
    board_mode: str
    active: tuple[str, ...] = ()
    cause: str | None = None

    @property
    def away_m(self) -> float:
        return math.hypot(self.north_m, self.east_m)


@dataclass(frozen=True, slots=True)
class Limits:
    """What a flight must keep, from the failure on; at ``settled_s`` it has turned home.

    ``trigger`` and ``action`` are those of failsafe.yml ("": none is demanded), ``priority`` the
    triggers that decide before it. ``may_land``: it may sink to the ground. ``circle_m`` is the
    diameter of a circle that it flies away from home, ``arrived_m`` is near home.
    """

    stall_m_s: float
    fail_s: float
    deadline_s: float
    settled_s: float
    trigger: str = ""
    action: str = ""
    priority: tuple[str, ...] = ()
    radius_m: float | None = None
    ceiling_m: float | None = None
    floor_m: float | None = None
    may_land: bool = False
    is_blown: bool = False
    arrived_m: float = 150.0
    circle_m: float = 0.0


@dataclass(frozen=True, slots=True)
class Figures:
    """What the pilot wants to know since the failure; ``reaction_s`` is None without one."""

    height_lost_m: float
    greatest_m: float
    least_m_s: float
    lowest_m: float
    highest_m: float
    drift_m_min: float
    reaction_s: float | None
    flown_s: float


def judge(track: Sequence[Sample], limits: Limits, crash: str | None = None) -> Found:
    """Return what was wrong, by code, and when (s), causes first; empty: it held.

    ``crash`` names the crash that ended the flight; a landing is not a crash.
    """
    found: dict[str, float] = {}
    for code, time_s in _found(track, limits, crash):
        found.setdefault(code, time_s)
    return tuple(sorted(found.items(), key=lambda each: CODES.index(each[0])))


def figures_of(track: Sequence[Sample], limits: Limits) -> Figures:
    """Return the figures; the drift is that of the time after the reaction was due."""
    since = [each for each in track if each.time_s >= limits.fail_s] or track[-1:]
    late = [each for each in since if each.time_s >= limits.deadline_s] or since[-1:]
    heights = [each.height_m for each in since]
    span_s = max(1.0, late[-1].time_s - late[0].time_s)
    return Figures(
        max(0.0, heights[0] - min(heights)),
        max(each.away_m for each in track),
        min(each.airspeed_m_s for each in track),
        min(heights),
        max(heights),
        60 * math.dist(*((e.north_m, e.east_m) for e in (late[0], late[-1]))) / span_s,
        reaction_s(track, limits),
        track[-1].time_s,
    )


def reaction_s(track: Sequence[Sample], limits: Limits) -> float | None:
    """Return how long after the failure the action of failsafe.yml flew; None: it did not.

    While a trigger that decides before it acts, it only has to be seen.
    """
    for each in track:
        if each.time_s >= limits.fail_s and limits.trigger in each.active:
            causes = (limits.trigger, *limits.priority)
            acts = each.mode == limits.action or each.cause in causes
            if limits.action == WARN or (acts and each.board_mode in FOLLOWED):
                return each.time_s - limits.fail_s
    return None


def _found(
    track: Sequence[Sample], limits: Limits, crash: str | None
) -> Iterator[tuple[str, float]]:
    least_m_s = limits.stall_m_s * STALL_MARGIN
    if limits.trigger:
        after_s = reaction_s(track, limits)
        if after_s is None or limits.fail_s + after_s > limits.deadline_s:
            yield "no_reaction", limits.deadline_s
    fast_s, settled_m, was_above = track[0].time_s, None, False
    for each in track:
        if each.airspeed_m_s >= least_m_s or each.height_m < GROUND_M:
            fast_s = each.time_s
        elif each.time_s - fast_s > SLOW_S:
            yield "stall", each.time_s
        if limits.radius_m is not None and each.away_m > limits.radius_m and not limits.is_blown:
            yield "outside", each.time_s
        if limits.ceiling_m is not None and each.height_m > limits.ceiling_m:
            yield "above_ceiling", each.time_s
        if limits.floor_m is not None and not limits.may_land:
            was_above = was_above or each.height_m > limits.floor_m + FLOOR_M
            if was_above and each.height_m < limits.floor_m:
                yield "below_floor", each.time_s
        if each.time_s >= limits.settled_s and not limits.is_blown:
            settled_m = each.away_m if settled_m is None else settled_m
            if each.away_m > max(settled_m + FARTHER_M + limits.circle_m, limits.arrived_m):
                yield "fly_away", each.time_s
    if crash is not None:
        yield "crash", track[-1].time_s
