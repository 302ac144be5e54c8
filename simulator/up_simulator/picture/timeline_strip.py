"""The strip above the panels: the modes by name, and a label for everything that happened."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from up_simulator.picture.palette import BANDS, FAULT, INK, MUTED, OTHER_BAND, PAPER
from up_simulator.picture.series import Span

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROW_IN = 0.19
BAND_IN = 0.22
GAP_IN = 0.08
SIZE_PT = 8.5
MAX_ROWS = 12
LONGEST = 60


@dataclass(frozen=True, slots=True)
class Mark:
    """Something that happened at a time; ``is_fault``: something broke."""

    at_s: float
    text: str
    is_fault: bool = False


@dataclass(frozen=True, slots=True)
class PlacedMark:
    """A mark with the row of its label, 0 the lowest, and the side of its line that it is on."""

    mark: Mark
    text: str
    row: int
    is_left: bool


def place_marks(
    marks: Sequence[Mark],
    begin_s: float,
    end_s: float,
    width_in: float,
    measure: Callable[[str], float],
) -> tuple[list[PlacedMark], int]:
    """Return the labels in rows without overlaps, and how many found no room in twelve rows.

    A label begins at its line; near the right end it ends there.
    """
    seconds = max(end_s - begin_s, 1e-9)
    placed: list[PlacedMark] = []
    taken: list[_Taken] = []
    left_out = 0
    # From the right, so that the line of a later mark ends below the label of an earlier one.
    for mark in sorted(marks, key=lambda mark: mark.at_s, reverse=True):
        if not begin_s <= mark.at_s <= end_s:
            continue
        text = mark.text if len(mark.text) <= LONGEST else f"{mark.text[: LONGEST - 1]}…"
        wide = measure(text) + GAP_IN
        line = (mark.at_s - begin_s) / seconds * width_in
        is_left = line + wide > width_in and line > wide
        low, high = (line - wide, line) if is_left else (line, line + wide)
        row = next((row for row in range(MAX_ROWS) if _is_free(taken, row, low, high)), None)
        if row is None:
            left_out += 1
            continue
        taken.append(_Taken(row, low, high, line))
        placed.append(PlacedMark(mark, text, row, is_left))
    return placed[::-1], left_out


@dataclass(frozen=True, slots=True)
class _Taken:
    """Position of a label, inches, and the line that rises to it."""

    row: int
    low: float
    high: float
    line: float


def _is_free(taken: Sequence[_Taken], row: int, low: float, high: float) -> bool:
    return not any(
        (each.row == row and low < each.high and each.low < high)
        or (each.row >= row and low < each.line < high)
        for each in taken
    )


def strip_height_in(placed: Sequence[PlacedMark], has_bands: bool) -> float:
    """Return how high the strip is."""
    rows = 1 + max((each.row for each in placed), default=-1)
    return rows * ROW_IN + (BAND_IN if has_bands else 0.0) + 0.02


def draw_strip(
    axes: Axes,
    height_in: float,
    spans: Sequence[Span],
    placed: Sequence[PlacedMark],
    measure: Callable[[str], float],
    width_in: float,
) -> None:
    """Draw the strip into axes that share the panels' time."""
    axes.set_ylim(0, height_in)
    axes.set_axis_off()
    begin_s, end_s = axes.get_xlim()
    foot = BAND_IN if spans else 0.0
    for span in spans:
        axes.axvspan(span.begin_s, span.end_s, 0, foot / height_in, color=band_colour(span.name))
        room_in = (span.end_s - span.begin_s) / (end_s - begin_s) * width_in
        if measure(span.name) + 0.06 <= room_in:
            middle_s = (span.begin_s + span.end_s) / 2
            axes.text(
                middle_s,
                foot / 2,
                span.name,
                ha="center",
                va="center_baseline",
                size=SIZE_PT,
                bbox={"facecolor": band_colour(span.name), "edgecolor": "none", "pad": 1},
                zorder=4,
            )
    for each in placed:
        colour = FAULT if each.mark.is_fault else MUTED
        low = foot + each.row * ROW_IN
        axes.plot([each.mark.at_s] * 2, [0, low + ROW_IN - 0.02], color=colour, lw=0.8)
        offset = (-4 if each.is_left else 4, 0)
        axes.annotate(
            each.text,
            (each.mark.at_s, low + ROW_IN / 2),
            xytext=offset,
            textcoords="offset points",
            ha="right" if each.is_left else "left",
            va="center",
            size=SIZE_PT,
            color=FAULT if each.mark.is_fault else INK,
            bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 0.8},
            zorder=4,
        )


def draw_background(axes: Axes, spans: Sequence[Span], placed: Sequence[PlacedMark]) -> None:
    """Draw the modes and the lines of the marks behind a panel."""
    for span in spans:
        axes.axvspan(span.begin_s, span.end_s, color=band_colour(span.name), lw=0, zorder=0)
    for each in placed:
        colour = FAULT if each.mark.is_fault else MUTED
        axes.axvline(each.mark.at_s, color=colour, lw=0.8, zorder=1.5)


def band_colour(mode: str) -> str:
    """Return the colour of a mode."""
    return BANDS.get(mode, OTHER_BAND)
