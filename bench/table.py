"""One table of figures: ours, a peer's, their ratio and the target."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from bench.timing import Limit, Spread

NOT_INSTALLED = "not installed"


class LeftOutError(Exception):
    """This machine lacks a requirement of the measurement; the message names it."""


@dataclass(frozen=True, slots=True)
class Row:
    """One figure; all texts are ready to print.

    ``met`` is None without a target and if it cannot be judged. ``left_out``: the reason for a
    missing figure, of ours or of the peer.
    """

    what: str
    ours: str = ""
    peer: str = ""
    peer_figure: str = ""
    ratio: str = ""
    target: str = ""
    met: bool | None = None
    is_noisy: bool = False
    left_out: str = ""


HEADINGS = ("what", "ours", "peer", "peer's", "ratio (quartiles)", "target", "met")
_MET = {True: "yes", False: "NO", None: "-"}


def figure(value: float, unit: str = "") -> str:
    size = math.floor(math.log10(abs(value))) if value and math.isfinite(value) else 0
    return f"{value:.{max(0, 2 - size)}f} {unit}".rstrip()


def compared(
    what: str,
    unit: str,
    ours: Sequence[float],
    peer: str = "",
    theirs: Sequence[float] = (),
    limit: Limit | None = None,
    missing: str = NOT_INSTALLED,
) -> Row:
    """Return the row of our figures and a peer's from the same alternating rounds.

    The ratio is the median of the rounds' ratios. ``limit`` limits the ratio: at most, or at least
    that many times better; without a peer it limits the figure. Without figures of the peer,
    ``missing`` gives the reason.
    """
    is_gain = limit is not None and limit.is_minimum
    suffix = f" {unit}".rstrip() if not peer else "x better" if is_gain else "x"
    target = f"{'>=' if is_gain else '<='} {limit.value:g}{suffix}" if limit else ""
    mine = figure(Spread.of(ours).median, unit)
    if peer and not theirs:
        return Row(what, mine, peer, "-", target=target, left_out=missing)
    ratios = list(ours)
    if peer:
        pairs = zip(theirs, ours, strict=True) if is_gain else zip(ours, theirs, strict=True)
        ratios = [math.inf if below <= 0 else above / below for above, below in pairs]
    spread = Spread.of(ratios)
    met = spread.meets(limit) if limit else None
    between = f"{figure(spread.low)} to {figure(spread.high)}" if len(ours) > 1 else ""
    return Row(
        what,
        mine,
        peer,
        figure(Spread.of(theirs).median, unit) if peer else "",
        f"{figure(spread.median)}{suffix} ({between})" if peer else between,
        target,
        met,
        is_noisy=math.isnan(spread.median) or (limit is not None and met is None),
    )


def limited(what: str, unit: str, value: float, limit: float) -> Row:
    """Return the row of one figure that may be at most ``limit``."""
    return Row(what, figure(value, unit), target=f"<= {limit:g} {unit}", met=value <= limit)


def _cells(row: Row) -> tuple[str, ...]:
    met = "too noisy" if row.is_noisy else _MET[row.met]
    return (row.what, row.ours, row.peer, row.peer_figure, row.ratio, row.target, met)


def format_table(rows: Iterable[Row], is_markdown: bool = False) -> str:
    """Return the rows as aligned columns under their headings, then the missing figures."""
    rows = list(rows)
    lines = [HEADINGS, *(_cells(row) for row in rows if row.ours)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(HEADINGS))]
    rule = tuple("-" * width for width in widths)
    edge, between = ("| ", " | ") if is_markdown else ("", "  ")
    padded = [
        edge
        + between.join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        + edge[::-1]
        for line in (lines[0], rule, *lines[1:])
    ]
    absent = [
        f"    {row.what}{f', beside {row.peer}' if row.peer else ''}: {row.left_out}"
        for row in rows
        if row.left_out
    ]
    return "\n".join([*padded, *(["left out:", *absent] if absent else [])])
