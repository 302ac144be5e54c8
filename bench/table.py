"""One table of figures: ours, a peer's, their ratio and the target."""

import sys
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TextIO


@dataclass(frozen=True, slots=True)
class Row:
    """One figure; all texts are ready to print, `met` is None where nothing was to be met."""

    what: str
    ours: str
    peer: str = ""
    peer_figure: str = ""
    ratio: str = ""
    target: str = ""
    met: bool | None = None


HEADINGS = ("what", "ours", "peer", "peer's", "ratio", "target", "met")
_MET = {True: "yes", False: "NO", None: "-"}


def _cells(row: Row) -> tuple[str, ...]:
    return (
        row.what, row.ours, row.peer, row.peer_figure, row.ratio, row.target, _MET[row.met]
    )  # fmt: skip


def format_table(rows: Iterable[Row]) -> str:
    """Return the rows as aligned columns under their headings."""
    lines = [HEADINGS, *(_cells(row) for row in rows)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(HEADINGS))]
    rule = tuple("-" * width for width in widths)
    padded = (
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in (lines[0], rule, *lines[1:])
    )
    return "\n".join(padded)


def print_table(rows: Iterable[Row], stream: TextIO | None = None) -> None:
    """Print the rows; a generator's rows appear when all are there."""
    print(format_table(rows), file=stream or sys.stdout)
