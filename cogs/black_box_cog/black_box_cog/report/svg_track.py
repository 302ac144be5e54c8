"""The track as an SVG in the page, for a report without pictures."""

from __future__ import annotations

import math
from collections.abc import Sequence

from black_box_cog.pictures.track_picture import Path, TrackView
from black_box_cog.report.html_text import Markup, join, tag

_SIZE, _EDGE, _MOST_LINES = 640.0, 60.0, 8
_MOST_POINTS = 3000
_LEAST_M = 40.0
_STEPS_M = (5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000)


def svg_track(view: TrackView) -> Markup:
    """Return the track over a plain grid in metres, north up."""
    paths = [view.path, *([view.truth] if view.truth is not None else [])]
    east = [0.0, *(value for path in paths for value in path.east_m if math.isfinite(value))]
    north = [0.0, *(value for path in paths for value in path.north_m if math.isfinite(value))]
    half_m = max(max(east) - min(east), max(north) - min(north), _LEAST_M) * 0.55
    field = _Field((max(east) + min(east)) / 2, (max(north) + min(north)) / 2, half_m)
    last = [at for at, value in enumerate(view.path.east_m) if math.isfinite(value)][-1]
    end = field.place(view.path.east_m[last], view.path.north_m[last])
    home = field.place(0.0, 0.0)
    return tag(
        "svg",
        *_grid(field),
        _line(field, view.truth, "truth") if view.truth is not None else None,
        _line(field, view.path, "track"),
        tag("circle", cx=f"{home[0]:.1f}", cy=f"{home[1]:.1f}", r=7, class_="home"),
        tag(
            "rect", x=f"{end[0] - 5:.1f}", y=f"{end[1] - 5:.1f}", width=10, height=10, class_="end"
        ),
        viewBox=f"0 0 {_SIZE:.0f} {_SIZE:.0f}",
        role="img",
        aria_label="the track from above, north up; a disc is the home, a square the end",
    )


class _Field:
    """Converts metres to positions in the drawing."""

    def __init__(self, east_m: float, north_m: float, half_m: float) -> None:
        self.east_m, self.north_m, self.half_m = east_m, north_m, half_m
        self._scale = (_SIZE - 2 * _EDGE) / (2 * half_m)

    def place(self, east_m: float, north_m: float) -> tuple[float, float]:
        middle = _SIZE / 2
        return (
            middle + (east_m - self.east_m) * self._scale,
            middle - (north_m - self.north_m) * self._scale,
        )


def _grid(field: _Field) -> list[Markup]:
    step_m = next((each for each in _STEPS_M if 2 * field.half_m / each <= _MOST_LINES), 100_000)
    drawn = []
    for is_north, middle_m in ((False, field.east_m), (True, field.north_m)):
        first = math.ceil((middle_m - field.half_m) / step_m)
        for number in range(first, math.floor((middle_m + field.half_m) / step_m) + 1):
            metres = number * step_m
            if is_north:
                _, y = field.place(0.0, metres)
                ends = (_EDGE, y, _SIZE - _EDGE, y)
                spot, anchor = (_EDGE - 6, y + 4), "end"
            else:
                x, _ = field.place(metres, 0.0)
                ends = (x, _EDGE, x, _SIZE - _EDGE)
                spot, anchor = (x, _SIZE - _EDGE + 18), "middle"
            names = ("x1", "y1", "x2", "y2")
            where = {name: f"{value:.1f}" for name, value in zip(names, ends, strict=True)}
            drawn.append(tag("line", class_="grid", **where))
            text = f"{metres} m" if number else "0"
            drawn.append(
                tag("text", text, x=f"{spot[0]:.1f}", y=f"{spot[1]:.1f}", text_anchor=anchor)
            )
    return drawn


def _line(field: _Field, path: Path, kind: str) -> Markup:
    every = math.ceil(len(path.east_m) / _MOST_POINTS) or 1
    runs: list[list[str]] = [[]]
    for at in _kept(len(path.east_m), every):
        if not math.isfinite(path.east_m[at]):
            runs.append([])
            continue
        x, y = field.place(path.east_m[at], path.north_m[at])
        runs[-1].append(f"{x:.1f},{y:.1f}")
    return join(*(tag("polyline", points=" ".join(run), class_=kind) for run in runs if run))


def _kept(count: int, every: int) -> Sequence[int]:
    return [*range(0, count, every), *([count - 1] if count % every != 1 else [])]
