"""A grid of styled characters; drawing outside the grid is clipped."""

from __future__ import annotations

from enum import Enum

MOST_COLUMNS = 300
MOST_ROWS = 100


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


class Canvas:
    """Text is written with `put`; rows are read as plain text or with ANSI sequences.

    Only printable ASCII and letters that `safe_text` passed may be put.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self.columns = max(1, min(columns, MOST_COLUMNS))
        self.rows = max(1, min(rows, MOST_ROWS))
        self._text = [[" "] * self.columns for _ in range(self.rows)]
        self._style = [[Style.PLAIN] * self.columns for _ in range(self.rows)]

    def put(self, row: int, column: int, text: str, style: Style = Style.PLAIN) -> int:
        """Write a text and return the column after it."""
        if 0 <= row < self.rows:
            for place, character in enumerate(text, column):
                if 0 <= place < self.columns:
                    self._text[row][place] = character
                    self._style[row][place] = style
        return column + len(text)

    def fill(self, row: int, style: Style) -> None:
        """Give a whole row a style."""
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
