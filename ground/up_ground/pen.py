"""Writes readings on the canvas, stale ones in the stale style."""

from __future__ import annotations

from dataclasses import dataclass

from up_ground.canvas import Canvas, Style
from up_ground.telemetry import Telemetry
from up_ground.wording import age_text


@dataclass(frozen=True, slots=True)
class Pen:
    """Canvas, telemetry and time for the drawing functions.

    A reading has its own age in telemetry; ``""`` stands for a value as old as its frame.
    """

    canvas: Canvas
    telemetry: Telemetry
    now_s: float

    def is_old(self, reading: str = "") -> bool:
        """Return whether a reading must be marked stale."""
        if reading:
            return self.telemetry.is_stale(reading, self.now_s)
        return self.telemetry.is_silent(self.now_s)

    def value(
        self, row: int, column: int, text: str, reading: str = "", style: Style = Style.PLAIN
    ) -> int:
        """Write a value, dim when it is old; return the column after it."""
        return self.canvas.put(row, column, text, Style.DIM if self.is_old(reading) else style)

    def title(self, row: int, column: int, text: str, reading: str = "") -> None:
        """Write a heading with the source and the age of its reading."""
        column = self.canvas.put(row, column, text, Style.BOLD)
        if reading:
            self.canvas.put(row, column + 1, self.age(reading), self._age_style(reading))

    def age(self, reading: str) -> str:
        """Return the source and the age of a reading."""
        source = self.telemetry.text("source", reading, limit=12)
        age = age_text(self.telemetry.reading_age_s(reading, self.now_s))
        return f"{source} {age}" if source else age

    def _age_style(self, reading: str) -> Style:
        known = self.telemetry.reading_age_s(reading, self.now_s) is not None
        return Style.BAD if known and self.is_old(reading) else Style.DIM
