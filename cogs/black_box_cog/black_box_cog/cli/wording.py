"""How the verbs tell times, sizes and lists to a person."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from datetime import datetime

from up.fields import printable

EARLIEST_UNIX_S = 1_735_689_600.0
"""2025: no flight was recorded before; a Raspberry Pi without a clock starts long before."""
_MIB = 1e6


def tell(text: str = "") -> None:
    """Show a line to the user."""
    print(text)  # noqa: T201 - the user's answer


def warn(text: str) -> None:
    """Show a line that is not part of the answer."""
    print(text, file=sys.stderr)  # noqa: T201 - the user's answer


def duration_text(seconds: float) -> str:
    """Return 8.4 s, 2 min 05 s or 1 h 02 min."""
    if seconds < 60:
        return f"{seconds:.1f} s" if seconds < 59.95 else "1 min 00 s"
    whole = round(seconds)
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def clock_text(seconds: float) -> str:
    """Return a time of the flight as minutes and seconds: 2:05.3."""
    tenths = round(seconds * 10)
    return f"{tenths // 600}:{tenths % 600 // 10:02d}.{tenths % 10}"


def start_text(unix_s: float) -> str:
    """Return the local time of a start; says so where the clock cannot have been right."""
    try:
        text = datetime.fromtimestamp(unix_s).astimezone().strftime("%Y-%m-%d %H:%M:%S")
    except (OverflowError, ValueError, OSError):
        return "no time (the clock was wrong)"
    return text if is_clock_right(unix_s) else f"{text} (the clock was wrong)"


def is_clock_right(unix_s: float, now_unix_s: float | None = None) -> bool:
    """Return whether a flight can have begun then: not before this program, nor tomorrow."""
    now_unix_s = datetime.now().timestamp() if now_unix_s is None else now_unix_s
    return EARLIEST_UNIX_S <= unix_s <= now_unix_s + 86400


def size_text(count: int) -> str:
    """Return a file's size in megabytes, as disks and their makers count them."""
    return f"{count / _MIB:.1f} MB"


def table(head: Sequence[str], rows: Iterable[Sequence[str]], right: Sequence[int] = ()) -> str:
    """Return lines with aligned columns; those numbered in ``right`` end at one place.

    Whatever a terminal would carry out is escaped.
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
