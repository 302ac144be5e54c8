"""The track seen from above."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from up_simulator.picture.palette import BLUE, FAULT, GREEN, INK, MUTED, PAPER, VERMILION
from up_simulator.picture.series import Log, crash_index, track

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MAX_DOTS = 12
MIN_RANGE_M = 40.0
_STEPS_S = (1, 2, 5, 10, 20, 30, 60, 120, 300, 600)


@dataclass(frozen=True, slots=True)
class Wind:
    """Mean wind of the flight: speed, and the direction from which it blows."""

    speed_m_s: float
    from_deg: float


def draw_track(axes: Axes, log: Log, wind: Wind | None) -> bool:
    """Draw the track, metres north and east, north up; return whether the log has it."""
    path = track(log)
    if path is None:
        return False
    east, north = path
    times_s = log.numbers("time_s")
    known = [at for at in range(len(east)) if math.isfinite(east[at] + north[at])]
    if not known:
        return False
    axes.plot(east, north, color=BLUE, lw=1.5, zorder=3)
    _dots(axes, east, north, times_s, known)
    first, last = known[0], known[-1]
    axes.plot(east[first], north[first], "o", ms=8, color=GREEN, zorder=5, label="start")
    crash = crash_index(log)
    if crash is None:
        axes.plot(east[last], north[last], "s", ms=7, color=INK, zorder=5, label="end")
    else:
        axes.plot(
            east[crash], north[crash], "X", ms=11, color=FAULT, mec="w", zorder=6, label="crash"
        )
    axes.set_aspect("equal", adjustable="datalim")
    _frame(axes, [east[at] for at in known], [north[at] for at in known])
    axes.set_xlabel("east (m)")
    axes.set_ylabel("north (m)")
    axes.set_title("Track from above", loc="left", size=10, weight="bold", pad=5)
    axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncol=2,
        borderaxespad=0.1,
        handlelength=1.2,
        columnspacing=1.4,
    )
    if wind is not None and wind.speed_m_s > 0:
        _arrow(axes, wind)
    return True


def _dots(
    axes: Axes,
    east: Sequence[float],
    north: Sequence[float],
    times_s: Sequence[float],
    known: Sequence[int],
) -> None:
    """Mark round times along the track."""
    seconds = times_s[known[-1]] - times_s[known[0]]
    step_s = next((step for step in _STEPS_S if seconds / step <= MAX_DOTS), _STEPS_S[-1])
    due_s = step_s * math.ceil((times_s[known[0]] + 0.5 * step_s) / step_s)
    for at in known:
        if times_s[at] < due_s - 1e-6:
            continue
        axes.plot(east[at], north[at], "o", ms=3.2, color=BLUE, mec="w", mew=0.6, zorder=4)
        if times_s[known[-1]] - times_s[at] >= 0.4 * step_s:
            axes.annotate(
                f"{due_s:g} s",
                (east[at], north[at]),
                xytext=(5, 4),
                textcoords="offset points",
                size=7.5,
                color=MUTED,
                bbox={"facecolor": PAPER, "edgecolor": "none", "alpha": 0.75, "pad": 0.4},
                zorder=3.5,
            )
        due_s += step_s


def _frame(axes: Axes, east: Sequence[float], north: Sequence[float]) -> None:
    """Leave air around it, and a free corner at the top for the wind."""
    half = max(max(east) - min(east), max(north) - min(north), MIN_RANGE_M) * 0.62
    middle_east = (max(east) + min(east)) / 2
    middle_north = (max(north) + min(north)) / 2
    axes.set_xlim(middle_east - half, middle_east + half)
    axes.set_ylim(middle_north - half, middle_north + half)


def _arrow(axes: Axes, wind: Wind) -> None:
    to_rad = math.radians(wind.from_deg + 180)
    dx, dy = 0.045 * math.sin(to_rad), 0.045 * math.cos(to_rad)
    centre = (0.91, 0.93)
    axes.annotate(
        "",
        (centre[0] + dx, centre[1] + dy),
        xytext=(centre[0] - dx, centre[1] - dy),
        xycoords="axes fraction",
        textcoords="axes fraction",
        arrowprops={"arrowstyle": "-|>", "color": VERMILION, "lw": 2, "mutation_scale": 14},
        zorder=7,
    )
    axes.text(
        0.845,
        0.93,
        f"wind {wind.speed_m_s:g} m/s",
        transform=axes.transAxes,
        ha="right",
        va="center",
        size=8.5,
        zorder=7,
        bbox={"facecolor": "w", "edgecolor": "none", "alpha": 0.8, "pad": 1.5},
    )
