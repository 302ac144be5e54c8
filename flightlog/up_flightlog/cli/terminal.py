"""The terminal output of the verbs: lines, tables, progress."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable, Sequence
from typing import Self, TextIO

from up.fields import printable

_DELAY_S = 0.5
_PERIOD_S = 0.1


def echo(text: str = "") -> None:
    """Show a line to the user."""
    print(text)  # noqa: T201 - the user's answer


def warn(text: str) -> None:
    """Show a line that is not part of the answer."""
    print(text, file=sys.stderr)  # noqa: T201 - the user's answer


def table(head: Sequence[str], rows: Iterable[Sequence[str]], right: Sequence[int] = ()) -> str:
    """Return lines with aligned columns; those numbered in ``right`` are right-aligned.

    Control characters are escaped.
    """
    cells = [[printable(cell) for cell in row] for row in (head, *rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines = []
    for row in cells:
        parts = [
            cell.rjust(width) if number in right else cell.ljust(width)
            for number, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append("  ".join(parts).rstrip())
    return "\n".join(lines)


class Progress:
    """Shows ``text 12 of 300`` on a terminal once the operation has taken half a second.

    Use it as a context: the line is removed at the end. Prints nothing to a file or a pipe.
    """

    def __init__(self, text: str, count: int, stream: TextIO | None = None) -> None:
        self._text = text
        self._count = count
        self._stream = stream or sys.stderr
        self._is_terminal = self._stream.isatty()
        self._due_s = time.monotonic() + _DELAY_S
        self._is_shown = False

    def update(self, number: int) -> None:
        """Report the current item; the first is 1."""
        if self._is_terminal and time.monotonic() >= self._due_s:
            self._due_s = time.monotonic() + _PERIOD_S
            self._is_shown = True
            self._write(f"\r{self._text} {number} of {self._count}")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        if self._is_shown:
            self._write("\r\x1b[K")

    def _write(self, text: str) -> None:
        self._stream.write(text)
        self._stream.flush()
