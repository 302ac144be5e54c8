"""A grid of styled characters, and readings written on it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from up_ground.status_text import age_text
from up_ground.telemetry import Telemetry

MAX_COLUMNS = 300
MAX_ROWS = 100


class Style(Enum):
    """The style of a character; the value is its SGR parameters (ECMA-48)."""

    PLAIN = ""
    BOLD = "1"
    DIM = "2"
    HEADER = "7"
    GOOD = "32"
    WARNING = "33"
    BAD = "1;31"
    SKY = "37;44"
    EARTH = "30;43"


class ScreenBuffer:
    """Text is written with `put`; rows are read as plain text or with ANSI sequences.

    Only printable ASCII and letters that `sanitize_text` passed may be put.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self.columns = max(1, min(columns, MAX_COLUMNS))
        self.rows = max(1, min(rows, MAX_ROWS))
        self._text = [[" "] * self.columns for _ in range(self.rows)]
        self._style = [[Style.PLAIN] * self.columns for _ in range(self.rows)]

    def put(self, row: int, column: int, text: str, style: Style = Style.PLAIN) -> int:
        if 0 <= row < self.rows:
            for place, character in enumerate(text, column):
                if 0 <= place < self.columns:
                    self._text[row][place] = character
                    self._style[row][place] = style
        return column + len(text)

    def fill(self, row: int, style: Style) -> None:
        if 0 <= row < self.rows:
            self._style[row] = [style] * self.columns

    def plain(self) -> str:
        """Return the rows without styles and without the blanks at their ends."""
        return "\n".join("".join(row).rstrip() for row in self._text)

    def ansi(self) -> str:
        """Return the rows, each complete in itself: it ends unstyled."""
        return "\n".join(map(_ansi_row, self._text, self._style))


def _ansi_row(characters: list[str], styles: list[Style]) -> str:
    out: list[str] = []
    current = Style.PLAIN
    for character, style in zip(characters, styles, strict=True):
        if style is not current:
            out.append("\x1b[0m" if style is Style.PLAIN else f"\x1b[0;{style.value}m")
            current = style
        out.append(character)
    if current is not Style.PLAIN:
        out.append("\x1b[0m")
        return "".join(out)
    return "".join(out).rstrip()


@dataclass(frozen=True, slots=True)
class PanelWriter:
    """ScreenBuffer, telemetry and time for the drawing functions.

    A reading has its own age in telemetry; ``""`` stands for a value as old as its frame.
    """

    screen: ScreenBuffer
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
        return self.screen.put(row, column, text, Style.DIM if self.is_old(reading) else style)

    def title(self, row: int, column: int, text: str, reading: str = "") -> None:
        column = self.screen.put(row, column, text, Style.BOLD)
        if reading:
            self.screen.put(row, column + 1, self.age(reading), self._age_style(reading))

    def age(self, reading: str) -> str:
        source = self.telemetry.text("source", reading, limit=12)
        age = age_text(self.telemetry.reading_age_s(reading, self.now_s))
        return f"{source} {age}" if source else age

    def _age_style(self, reading: str) -> Style:
        known = self.telemetry.reading_age_s(reading, self.now_s) is not None
        return Style.BAD if known and self.is_old(reading) else Style.DIM
