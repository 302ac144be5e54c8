"""The terminal output of the verbs."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence

from up.fields import printable


def tell(text: str = "") -> None:
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
