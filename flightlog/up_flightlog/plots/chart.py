"""The data of charts over time, without any drawing."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from operator import sub

MAX_POINTS = 4000
MAX_VALUE = 1e15
"""A larger value is a fault of its sender, and no axis can show it beside the rest."""
GAP_S = 1.0
_LAPSES = 6.0


@dataclass(frozen=True, slots=True)
class Curve:
    """One line: ``colour`` names a theme colour, ``gap_s`` is the silence that breaks the line.

    Without ``gap_s`` that is a second, or six of its usual periods if that is longer.
    """

    label: str
    times_s: Sequence[float]
    values: Sequence[float]
    colour: str
    style: str = "-"
    width: float = 1.3
    is_step: bool = False
    gap_s: float | None = None
    is_ready: bool = False
    """Whether its points are few and have their breaks already: see `ready`."""


@dataclass(frozen=True, slots=True)
class Shade:
    """A hatched time span of a panel; ``height`` is its share of the panel, from the bottom."""

    begin_s: float
    end_s: float
    height: float = 1.0


@dataclass(frozen=True, slots=True)
class Panel:
    """Curves over one axis; ``min_range`` keeps noise from looking like movement."""

    title: str
    unit: str
    curves: Sequence[Curve]
    about: float | None = None
    """A value marked by a thin line."""
    min_range: float = 0.0
    share: float = 1.0
    shades: Sequence[Shade] = ()


@dataclass(frozen=True, slots=True)
class Band:
    """A named part of the flight: its mode."""

    begin_s: float
    end_s: float
    name: str


@dataclass(frozen=True, slots=True)
class Mark:
    """A moment with an event; its text is a label above the panels."""

    at_s: float
    is_bad: bool = False
    text: str = ""


@dataclass(frozen=True, slots=True)
class Background:
    """The background that all panels of a flight share."""

    length_s: float
    bands: Sequence[Band] = ()
    marks: Sequence[Mark] = ()


def drawable(curve: Curve, limit: int = MAX_POINTS) -> tuple[list[float], list[float]]:
    """Return the points to draw: few, with every peak kept and gaps left open."""
    if curve.is_ready:
        return list(curve.times_s), list(curve.values)
    return thinned(*broken(curve.times_s, curve.values, curve.gap_s), limit)


def ready(panels: Iterable[Panel]) -> list[Panel]:
    """Return the panels with only the points that are drawn, for several pictures of them."""
    return [
        replace(
            panel,
            curves=[
                replace(each, times_s=points[0], values=points[1], is_ready=True)
                for each in panel.curves
                for points in [drawable(each)]
            ],
        )
        for panel in panels
    ]


def is_drawable(value: float) -> bool:
    """Return whether an axis can show a value."""
    return abs(value) <= MAX_VALUE


def broken(
    times_s: Sequence[float], values: Sequence[float], gap_s: float | None = None
) -> tuple[list[float], list[float]]:
    """Return the points with a break (nan) at every gap of ``gap_s``."""
    longest_s = max(map(sub, times_s[1:], times_s), default=0.0)
    # The usual gap, which is slow to find, is never less than GAP_S.
    is_short = gap_s is None and longest_s <= GAP_S
    limit_s = GAP_S if is_short else usual_gap_s(times_s) if gap_s is None else gap_s
    if longest_s <= limit_s and is_drawable(sum(map(abs, values))):
        return list(times_s), list(values)
    found_s: list[float] = []
    found: list[float] = []
    last_s = math.inf
    for time_s, value in zip(times_s, values, strict=True):
        if time_s - last_s > limit_s:
            found_s.append(last_s)
            found.append(math.nan)
        found_s.append(time_s)
        found.append(value if is_drawable(value) else math.nan)
        last_s = time_s
    return found_s, found


def usual_gap_s(times_s: Sequence[float]) -> float:
    """Return the time without a value after which a source is silent: from its median period."""
    if len(times_s) < 3:
        return GAP_S
    periods: list[float] = sorted(map(sub, times_s[1:], times_s))
    return max(GAP_S, _LAPSES * periods[len(periods) // 2])


def thinned(
    times_s: Sequence[float], values: Sequence[float], limit: int = MAX_POINTS
) -> tuple[list[float], list[float]]:
    """Return about ``limit`` points at most: the minimum and maximum of each short stretch."""
    if len(values) <= limit:
        return list(times_s), list(values)
    width = math.ceil(2 * len(values) / limit)
    chosen: list[int] = []
    is_whole = not math.isnan(sum(values))
    for begin in range(0, len(values), width):
        if is_whole:
            part = values[begin : begin + width]
            chosen += sorted({begin + part.index(min(part)), begin + part.index(max(part))})
            continue
        stretch = range(begin, min(begin + width, len(values)))
        known = [at for at in stretch if not math.isnan(values[at])]
        # One open point is enough to break the line in a stretch with a gap.
        silent = [at for at in stretch if math.isnan(values[at])][:1]
        extremes = (
            {min(known, key=values.__getitem__), max(known, key=values.__getitem__)}
            if known
            else set()
        )
        chosen += sorted({*extremes, *silent})
    return [times_s[at] for at in chosen], [values[at] for at in chosen]
