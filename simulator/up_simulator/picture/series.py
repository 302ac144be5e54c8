"""Columns of a log for drawing: numbers, modes, the track."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from up_flightlog.plots.chart import Band
from up_flightlog.plots.track_picture import Path
from up_simulator.scenario.log import FlightLog


def numbers(log: FlightLog, name: str) -> list[float] | None:
    """Return a column, or ``None`` if it is missing or entirely unknown."""
    if name not in log:
        return None
    values = log.numbers(name)
    return values if any(math.isfinite(value) for value in values) else None


def mode_bands(log: FlightLog) -> list[Band]:
    """Return the modes with their times; a lost receiver's circle is the mode failsafe."""
    if "board.mode" not in log:
        return []
    modes = [str(mode) for mode in log.column("board.mode")]
    if "board.failsafe" in log:
        flags = log.numbers("board.failsafe")
        modes = ["failsafe" if flag == 1 else mode for mode, flag in zip(modes, flags, strict=True)]
    return list(_runs(log.numbers("time_s"), modes))


def track(log: FlightLog) -> Path | None:
    """Return metres east and north of the start; ``None`` if the log lacks them."""
    north, east = numbers(log, "truth.north_m"), numbers(log, "truth.east_m")
    return None if north is None or east is None else Path(log.numbers("time_s"), east, north)


def crash_index(log: FlightLog) -> int | None:
    """Return the row at which it crashed."""
    flags = numbers(log, "truth.crashed")
    return None if flags is None or 1.0 not in flags else flags.index(1.0)


def _runs(times_s: Sequence[float], names: Sequence[str]) -> Iterator[Band]:
    begin = 0
    for at in range(1, len(names) + 1):
        if at == len(names) or names[at] != names[begin]:
            if names[begin]:
                yield Band(times_s[begin], times_s[min(at, len(names) - 1)], names[begin])
            begin = at
