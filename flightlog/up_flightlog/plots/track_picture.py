"""The track seen from above, over a plain grid."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from up_flightlog.plots.canvas import Sheet

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MIN_M = 40.0
NARROW_IN = 6.0
_MAX_DOTS = 10
_STEPS_S = (1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600)


@dataclass(frozen=True, slots=True)
class Path:
    """Positions: metres east and north of the home, nan where unknown."""

    times_s: Sequence[float]
    east_m: Sequence[float]
    north_m: Sequence[float]


@dataclass(frozen=True, slots=True)
class Wind:
    """The mean wind: its speed, and the direction that it comes from."""

    speed_m_s: float
    from_deg: float


@dataclass(frozen=True, slots=True)
class TrackView:
    """The content of the picture of a track."""

    path: Path
    truth: Path | None = None
    wind: Wind | None = None
    marks: Sequence[float] = ()
    """Times of the user's marks, seconds."""
    is_crash: bool = False
    """The track ends in a crash."""


def draw_track(sheet: Sheet, view: TrackView) -> None:
    """Draw the track, north up."""
    theme, path = sheet.theme, view.path
    is_narrow = sheet.width < NARROW_IN
    top_in = 0.62 if is_narrow else 0.42
    axes = sheet.axes(0.62, top_in, sheet.width - 0.74, sheet.height - top_in - 0.48)
    if view.truth is not None:
        axes.plot(
            view.truth.east_m,
            view.truth.north_m,
            color=theme.blue,
            lw=3.2,
            alpha=0.45,
            zorder=2,
            label="truth",
        )
    label = "measured" if view.truth is not None else "track"
    axes.plot(path.east_m, path.north_m, color=theme.orange, lw=1.5, zorder=3, label=label)
    _dots(axes, view, sheet)
    known = _known(path)
    axes.plot(0.0, 0.0, "o", ms=8, color=theme.green, mec=theme.paper, zorder=5, label="home")
    last = known[-1]
    axes.plot(
        path.east_m[last],
        path.north_m[last],
        "X" if view.is_crash else "s",
        ms=7,
        color=theme.vermilion if view.is_crash else theme.ink,
        mec=theme.paper,
        zorder=5,
        label="crash" if view.is_crash else "end",
    )
    for at in (_index_at(path, known, time_s) for time_s in view.marks):
        axes.plot(path.east_m[at], path.north_m[at], "D", ms=6, color=theme.purple, zorder=5)
    _frame(axes, path, view.truth, sheet)
    axes.set_xlabel("metres east of home")
    axes.set_ylabel("metres north of home")
    axes.legend(
        loc="lower left" if is_narrow else "lower right",
        bbox_to_anchor=(0.0 if is_narrow else 1.0, 1.0),
        ncol=4,
        borderaxespad=0.1,
        handlelength=1.1,
        handletextpad=0.3,
        columnspacing=0.8,
    )
    if view.wind is not None and view.wind.speed_m_s >= 0.1:
        _draw_wind(axes, view.wind, sheet)


def _known(path: Path) -> list[int]:
    return [
        at
        for at in range(len(path.times_s))
        if math.isfinite(path.east_m[at]) and math.isfinite(path.north_m[at])
    ]


def _index_at(path: Path, known: Sequence[int], time_s: float) -> int:
    return min(known, key=lambda at: abs(path.times_s[at] - time_s))


def _dots(axes: Axes, view: TrackView, sheet: Sheet) -> None:
    path = view.path
    known = _known(path)
    begin_s, end_s = path.times_s[known[0]], path.times_s[known[-1]]
    step_s = next((each for each in _STEPS_S if (end_s - begin_s) / each <= _MAX_DOTS), 7200)
    due_s = step_s * math.ceil((begin_s + 0.3 * step_s) / step_s)
    while due_s <= end_s - 0.3 * step_s:
        at = _index_at(path, known, due_s)
        place = (path.east_m[at], path.north_m[at])
        axes.plot(*place, "o", ms=3.4, color=sheet.theme.orange, mec=sheet.theme.paper, zorder=4)
        axes.annotate(
            f"{due_s // 60}:{due_s % 60:02d}",
            place,
            xytext=(5, 4),
            textcoords="offset points",
            size=7.5,
            color=sheet.theme.muted,
            zorder=4.5,
        )
        due_s += step_s


def _frame(axes: Axes, path: Path, truth: Path | None, sheet: Sheet) -> None:
    """Use one scale for both axes, with a margin around the track."""
    paths = [path] if truth is None else [path, truth]
    east = [0.0, *(each.east_m[at] for each in paths for at in _known(each))]
    north = [0.0, *(each.north_m[at] for each in paths for at in _known(each))]
    width_in, height_in = sheet.size_of(axes)
    ratio = width_in / height_in
    half_north = max((max(north) - min(north)), (max(east) - min(east)) / ratio, MIN_M) * 0.57
    middle = ((max(east) + min(east)) / 2, (max(north) + min(north)) / 2)
    axes.set_xlim(middle[0] - half_north * ratio, middle[0] + half_north * ratio)
    axes.set_ylim(middle[1] - half_north, middle[1] + half_north)
    axes.set_aspect("equal", adjustable="box")


def _draw_wind(axes: Axes, wind: Wind, sheet: Sheet) -> None:
    """Draw the direction to which the wind blows, above the upper left corner."""
    to_rad = math.radians(wind.from_deg + 180)
    width_in, height_in = sheet.size_of(axes)
    reach_in = 0.14
    dx = reach_in * math.sin(to_rad) / width_in
    dy = reach_in * math.cos(to_rad) / height_in
    up_in = 0.45 if sheet.width < NARROW_IN else 0.2
    x, y = 0.15 / width_in, 1 + up_in / height_in
    axes.annotate(
        "",
        (x + dx, y + dy),
        xytext=(x - dx, y - dy),
        xycoords="axes fraction",
        textcoords="axes fraction",
        annotation_clip=False,
        arrowprops={"arrowstyle": "-|>", "color": sheet.theme.sky, "lw": 2, "mutation_scale": 13},
        zorder=7,
    )
    axes.text(
        0.38 / width_in,
        y,
        f"wind {wind.speed_m_s:.1f} m/s",
        transform=axes.transAxes,
        ha="left",
        va="center",
        size=8.5,
        color=sheet.theme.muted,
        zorder=7,
    )
