"""Judges a flight by its track: no Twisted, no simulator."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

FOLLOWED = ("SETPOINT", "OUTPUT", "RETURN")
"""Modes of the board in which it follows the Raspberry Pi."""
STALL_MARGIN = 1.05
SLOW_S = 0.3
"""So long it must be slow: a gust of turbulence is shorter."""
FARTHER_M = 100.0
TOUCH_DOWN_M_S = 3.0
CODES = (
    "refused", "no_reaction", "stall", "outside", "below_floor", "above_ceiling", "fly_away",
    "crash", "failed",
)  # fmt: skip
"""What may be wrong, causes before their effects."""


@dataclass(frozen=True, slots=True)
class Sample:
    """The truth, and what flies; positions from home, m. ``active``: the failsafes that hold."""

    time_s: float
    north_m: float
    east_m: float
    height_m: float
    airspeed_m_s: float
    climb_m_s: float
    mode: str | None
    board_mode: str
    active: tuple[str, ...] = ()
    cause: str | None = None

    @property
    def away_m(self) -> float:
        return math.hypot(self.north_m, self.east_m)


@dataclass(frozen=True, slots=True)
class Limits:
    """What a flight must keep. ``trigger`` and ``action`` are those of failsafe.yml; "": none.

    ``priority`` are the triggers that decide before ``trigger``: while one of them acts,
    ``trigger`` only has to be seen.
    """

    stall_m_s: float
    fail_s: float
    settled_s: float
    deadline_s: float
    trigger: str = ""
    action: str = ""
    priority: tuple[str, ...] = ()
    radius_m: float | None = None
    ceiling_m: float | None = None
    floor_m: float | None = None
    may_land: bool = False
    is_blown: bool = False
    arrived_m: float = 150.0


@dataclass(frozen=True, slots=True)
class Figures:
    """What the pilot wants to know of a flight; ``reaction_s`` is None without a reaction."""

    height_lost_m: float
    greatest_m: float
    least_airspeed_m_s: float
    least_height_m: float
    greatest_height_m: float
    drift_m_min: float
    reaction_s: float | None
    flown_s: float


@dataclass(frozen=True, slots=True)
class Verdict:
    """What was wrong, by code, and when; the causes first. Empty: it held."""

    found: tuple[tuple[str, float], ...]

    @property
    def codes(self) -> tuple[str, ...]:
        return tuple(code for code, _ in self.found)

    @property
    def is_held(self) -> bool:
        return not self.found


def judge(track: Sequence[Sample], limits: Limits, crash: str | None = None) -> Verdict:
    """Return what was wrong; ``crash`` is the end of the flight on the ground, if it was one."""
    found: dict[str, float] = {}
    for code, time_s in _found(track, limits, crash):
        found.setdefault(code, time_s)
    return Verdict(tuple(sorted(found.items(), key=lambda each: CODES.index(each[0]))))


def figures_of(track: Sequence[Sample], limits: Limits) -> Figures:
    """Return the figures since the failure."""
    since = [each for each in track if each.time_s >= limits.fail_s] or list(track[-1:])
    first, last = since[0], since[-1]
    settled = [each for each in since if each.time_s >= limits.deadline_s] or [last]
    span_s = last.time_s - settled[0].time_s
    drift_m = math.hypot(last.north_m - settled[0].north_m, last.east_m - settled[0].east_m)
    return Figures(
        height_lost_m=max(0.0, first.height_m - min(each.height_m for each in since)),
        greatest_m=max(each.away_m for each in track),
        least_airspeed_m_s=min(each.airspeed_m_s for each in since),
        least_height_m=min(each.height_m for each in since),
        greatest_height_m=max(each.height_m for each in since),
        drift_m_min=60 * drift_m / span_s if span_s > 1.0 else 0.0,
        reaction_s=reaction_s(track, limits),
        flown_s=last.time_s,
    )


def reaction_s(track: Sequence[Sample], limits: Limits) -> float | None:
    """Return how long after the failure the action of failsafe.yml flew; None: it did not."""
    for each in track:
        if each.time_s >= limits.fail_s and limits.trigger in each.active:
            is_done = limits.action in ("", "warn") or _acts(each, limits)
            if is_done:
                return each.time_s - limits.fail_s
    return None


def _acts(sample: Sample, limits: Limits) -> bool:
    flies = sample.board_mode in FOLLOWED
    is_wanted = sample.mode == limits.action or sample.cause == limits.trigger
    return flies and (is_wanted or sample.cause in limits.priority)


def _found(
    track: Sequence[Sample], limits: Limits, crash: str | None
) -> Iterator[tuple[str, float]]:
    if limits.trigger:
        reacted_s = reaction_s(track, limits)
        if reacted_s is None or limits.fail_s + reacted_s > limits.deadline_s:
            yield "no_reaction", limits.deadline_s
    yield from _slow(track, limits)
    yield from _borders(track, limits)
    yield from _gone(track, limits)
    last = track[-1]
    if crash is not None and not (limits.may_land and is_gentle(last, limits)):
        yield "crash", last.time_s


def is_gentle(last: Sample, limits: Limits) -> bool:
    """Return whether the aircraft touches down as a glider lands."""
    is_fast = last.airspeed_m_s >= limits.stall_m_s * STALL_MARGIN
    return is_fast and last.climb_m_s >= -TOUCH_DOWN_M_S


def _slow(track: Sequence[Sample], limits: Limits) -> Iterator[tuple[str, float]]:
    since_s: float | None = None
    for each in track:
        if each.airspeed_m_s >= limits.stall_m_s * STALL_MARGIN:
            since_s = None
            continue
        since_s = each.time_s if since_s is None else since_s
        if each.time_s - since_s >= SLOW_S - 1e-6:
            yield "stall", since_s
            return


def _borders(track: Sequence[Sample], limits: Limits) -> Iterator[tuple[str, float]]:
    was_above = False
    for each in track:
        if limits.radius_m is not None and each.away_m > limits.radius_m and not limits.is_blown:
            yield "outside", each.time_s
        if limits.ceiling_m is not None and each.height_m > limits.ceiling_m:
            yield "above_ceiling", each.time_s
        if limits.floor_m is not None and not limits.may_land:
            was_above = was_above or each.height_m > limits.floor_m + FLOOR_M
            if was_above and each.height_m < limits.floor_m:
                yield "below_floor", each.time_s


FLOOR_M = 10.0
"""So high above the floor the estimate, which has an error, is surely above it."""


def _gone(track: Sequence[Sample], limits: Limits) -> Iterator[tuple[str, float]]:
    """Find the aircraft that flies away when it should have turned home, or circle."""
    if limits.is_blown:
        return
    settled_m: float | None = None
    for each in track:
        if each.time_s >= limits.settled_s:
            settled_m = each.away_m if settled_m is None else settled_m
            if each.away_m > max(settled_m + FARTHER_M, limits.arrived_m):
                yield "fly_away", each.time_s
                return
