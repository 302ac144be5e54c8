"""Labels of marks above the panels, in rows without overlaps."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from up_flightlog.plots.chart import Mark

ROW_IN = 0.19
GAP_IN = 0.08
SIZE_PT = 8.0
MAX_ROWS = 12
MAX_LENGTH = 60


@dataclass(frozen=True, slots=True)
class PlacedLabel:
    """A mark with the row of its label, 0 the lowest, and the side of its line that it is on."""

    mark: Mark
    text: str
    row: int
    is_left: bool


@dataclass(frozen=True, slots=True)
class _Taken:
    """Position of a label, inches, and the line that rises to it."""

    row: int
    low: float
    high: float
    line: float


def place_labels(
    marks: Sequence[Mark], length_s: float, width_in: float, measure: Callable[[str], float]
) -> tuple[list[PlacedLabel], int]:
    """Return the labels of marks with a text, and how many found no room in twelve rows.

    ``measure`` returns the width of a text, inches. A label begins at its line; near the right
    end it ends there.
    """
    placed: list[PlacedLabel] = []
    taken: list[_Taken] = []
    left_out = 0
    # From the right, so that the line of a later mark ends below the label of an earlier one.
    for mark in sorted(marks, key=lambda mark: mark.at_s, reverse=True):
        if not mark.text or not 0.0 <= mark.at_s <= length_s:
            continue
        is_long = len(mark.text) > MAX_LENGTH
        text = f"{mark.text[: MAX_LENGTH - 1]}…" if is_long else mark.text
        wide = measure(text) + GAP_IN
        line = mark.at_s / max(length_s, 1e-9) * width_in
        is_left = line + wide > width_in and line > wide
        low, high = (line - wide, line) if is_left else (line, line + wide)
        row = next((row for row in range(MAX_ROWS) if _is_free(taken, row, low, high)), None)
        if row is None:
            left_out += 1
            continue
        taken.append(_Taken(row, low, high, line))
        placed.append(PlacedLabel(mark, text, row, is_left))
    return placed[::-1], left_out


def _is_free(taken: Sequence[_Taken], row: int, low: float, high: float) -> bool:
    return not any(
        (each.row == row and low < each.high and each.low < high)
        or (each.row >= row and low < each.line < high)
        for each in taken
    )
