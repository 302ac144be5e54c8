"""The numbers of one value over a flight, with minima and maxima of blocks for quick overviews."""

from __future__ import annotations

import math
from array import array
from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

FACTOR = 16
"""A block of a level covers this many of the level below it."""
Floats = Sequence[float]
Level = tuple[Floats, Floats]
"""Minima and maxima of the blocks."""


def levels_of(values: array[float]) -> Iterator[tuple[array[float], array[float]]]:
    """Yield the levels above the values, each a sixteenth as long; none above a single block."""
    lows = highs = values
    while len(lows) > FACTOR:
        begins = range(0, len(lows), FACTOR)
        lows = array("f", (min(lows[at : at + FACTOR]) for at in begins))
        highs = array("f", (max(highs[at : at + FACTOR]) for at in begins))
        yield lows, highs


@dataclass(frozen=True, slots=True)
class Column:
    """``name`` is ``topic.field``; times in s from the log's first message.

    ``gap_s``: a longer time without a value is a silence, across which no line is drawn.
    """

    name: str
    unit: str
    gap_s: float
    times_s: Floats
    values: Floats
    levels: Sequence[Level]

    def extremes(self, begin: int, end: int) -> tuple[float, float]:
        """Return the minimum and maximum of the values from ``begin`` to before ``end``."""
        lows: list[float] = []
        highs: list[float] = []
        low, high = self.values, self.values
        for low_above, high_above in (*self.levels, ((), ())):
            begin_block, end_block = -(-begin // FACTOR), end // FACTOR
            if begin_block >= end_block or not low_above:
                break
            for edge in (slice(begin, begin_block * FACTOR), slice(end_block * FACTOR, end)):
                lows += low[edge]
                highs += high[edge]
            begin, end, low, high = begin_block, end_block, low_above, high_above
        return min([*lows, *low[begin:end]]), max([*highs, *high[begin:end]])

    def window(self, begin_s: float, end_s: float, pixels: int) -> Points:
        """Return what a chart of that many pixels shows of a span: two points a pixel at most.

        Every value, or the minimum and maximum within each pixel where there are more; a NaN
        stands in each silence. The neighbours of the span are included.
        """
        times_s, points = self.times_s, Points()
        at = max(0, bisect_left(times_s, begin_s) - 1)
        last = min(len(times_s), bisect_right(times_s, end_s) + 1)
        if last - at <= 2 * pixels:
            for each in range(at, last):
                self._open_gap(points, each)
                points.add(times_s[each], self.values[each])
            return points
        step_s = (end_s - begin_s) / pixels
        for pixel in range(1, pixels + 1):
            edge_s = begin_s + pixel * step_s
            end = last if pixel == pixels else bisect_right(times_s, edge_s, at, last)
            if end > at:
                self._open_gap(points, at)
                pair = self.extremes(at, end)
                is_falling = self.values[at] > self.values[end - 1]
                points.add(times_s[at], pair[is_falling])
                if end - at > 1:
                    points.add(times_s[end - 1], pair[not is_falling])
                at = end
        return points

    def samples(self, begin_s: float, end_s: float, limit: int) -> Points:
        """Return the values of a span as they are, from its begin; at most ``limit``."""
        begin = bisect_left(self.times_s, begin_s)
        end = min(bisect_right(self.times_s, end_s), begin + limit)
        return Points(array("d", self.times_s[begin:end]), array("f", self.values[begin:end]))

    def at(self, time_s: float) -> float:
        """Return the last value until a time; NaN before the first one and in a silence."""
        before = bisect_right(self.times_s, time_s) - 1
        if before < 0 or time_s - self.times_s[before] > self.gap_s:
            return math.nan
        return self.values[before]

    def _open_gap(self, points: Points, at: int) -> None:
        """Break the line before a value that follows a silence."""
        if points.times_s and self.times_s[at] - self.times_s[at - 1] > self.gap_s:
            points.add((self.times_s[at] + self.times_s[at - 1]) / 2, math.nan)


class Points:
    """Times (s) and values for a chart."""

    def __init__(self, times_s: Any = None, values: Any = None) -> None:
        self.times_s: array[float] = array("d") if times_s is None else times_s
        self.values: array[float] = array("f") if values is None else values

    def add(self, time_s: float, value: float) -> None:
        self.times_s.append(time_s)
        self.values.append(value)

    def encoded(self) -> bytes:
        """Return the times as doubles, then the values as floats, both little-endian."""
        return self.times_s.tobytes() + self.values.tobytes()
