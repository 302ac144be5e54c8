"""An artificial horizon in letters."""

from __future__ import annotations

import math

from up_ground.canvas import Canvas, Style

PITCH_RANGE_DEG = 60.0
"""From the upper edge of the picture to the lower one."""
_LETTER_ASPECT = 2.0
"""A character is about twice as high as it is wide."""


def draw_horizon(
    canvas: Canvas,
    row: int,
    column: int,
    size: tuple[int, int],
    attitude: tuple[float | None, float | None],
    dim: bool,
) -> None:
    """Draw the horizon as the pilot sees it.

    ``size`` is (columns, rows), ``attitude`` (roll, pitch) in degrees: right wing down and nose up
    are positive, so roll to the right raises the earth on the right. Unknown: an empty frame.
    """
    columns, rows = size
    roll_deg, pitch_deg = attitude
    if roll_deg is None or pitch_deg is None:
        for line in range(rows):
            canvas.put(row + line, column, "." * columns, Style.DIM)
        canvas.put(row + rows // 2, column + columns // 2 - 3, "  --  ", Style.DIM)
        return
    roll = math.radians(math.fmod(roll_deg, 360))
    pitch_rows = max(-90.0, min(90.0, pitch_deg)) * rows / PITCH_RANGE_DEG
    for line in range(rows):
        up = (rows - 1) / 2 - line
        for place in range(columns):
            right = (place - (columns - 1) / 2) / _LETTER_ASPECT
            height = up * math.cos(roll) - right * math.sin(roll) + pitch_rows
            letter, style = _letter(height)
            canvas.put(row + line, column + place, letter, Style.DIM if dim else style)
    style = Style.DIM if dim else Style.BOLD
    canvas.put(row + rows // 2, column + columns // 2 - 4, "--(", style)
    canvas.put(row + rows // 2, column + columns // 2, "+", style)
    canvas.put(row + rows // 2, column + columns // 2 + 2, ")--", style)


def _letter(height_rows: float) -> tuple[str, Style]:
    if abs(height_rows) < 0.5:
        return "=", Style.BOLD
    return (" ", Style.SKY) if height_rows > 0 else (":", Style.EARTH)
