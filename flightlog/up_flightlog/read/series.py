"""Numbers of a log over time."""

from __future__ import annotations

import math
from array import array
from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from operator import itemgetter
from typing import Any

from up.flight_log.json_message import number_at, value_at

GAP_S = 0.5
"""Values farther apart are not interpolated."""


def _numbers() -> array[float]:
    return array("d")


@dataclass(frozen=True, slots=True)
class Series:
    """Values and their times, seconds from the log's first message.

    Eight bytes each: a list of Python floats for an hour would take four times that.
    """

    times_s: array[float] = field(default_factory=_numbers)
    values: array[float] = field(default_factory=_numbers)

    def __bool__(self) -> bool:
        return bool(self.values)

    def add(self, time_s: float, value: float | None) -> None:
        if value is not None:
            self.times_s.append(time_s)
            self.values.append(value)

    def at(self, time_s: float) -> float | None:
        """Interpolate the value at a time; None if its neighbours are over ``GAP_S`` apart."""
        after = bisect_left(self.times_s, time_s)
        if after < len(self.times_s) and self.times_s[after] == time_s:
            return self.values[after]
        if not 0 < after < len(self.times_s):
            return None
        low_s, high_s = self.times_s[after - 1], self.times_s[after]
        if high_s - low_s > GAP_S:
            return None
        low, high = self.values[after - 1], self.values[after]
        return low + (high - low) * (time_s - low_s) / (high_s - low_s)


class Columns:
    """Collects a series for each field (dotted paths) of its messages."""

    def __init__(self, fields: Sequence[str]) -> None:
        self.series = {name: Series() for name in fields}
        self._groups: dict[tuple[str, ...], list[tuple[str, Series]]] = {}
        for name, series in self.series.items():
            *group, key = name.split(".")
            self._groups.setdefault(tuple(group), []).append((key, series))

    def add_all(self, times_s: Sequence[float], messages: Sequence[Mapping[str, Any]]) -> None:
        times = array("d", times_s)
        for group, fields in self._groups.items():
            inner = [value_at(each, group) for each in messages] if group else messages
            for key, series in fields:
                try:
                    found = [*map(itemgetter(key), inner)]
                except (KeyError, TypeError):
                    found = [value_at(each, (key,)) for each in inner]
                _add_values(series, times, found)


def _add_values(series: Series, times_s: array[float], values: list[Any]) -> None:
    kinds = {*map(type, values)}
    # Nearly always all of them are numbers, or all are missing: neither needs a call for each.
    if kinds == {type(None)}:
        return
    if kinds <= {float, int}:
        try:
            series.values.fromlist(values)
        except OverflowError:
            pass
        else:
            series.times_s.extend(times_s)
            return
    for time_s, value in zip(times_s, values, strict=True):
        series.add(time_s, number_at(value, ()))


def turn(degrees: float) -> float:
    """Return the same angle between -180 and 180."""
    return (degrees + 180) % 360 - 180


@dataclass(frozen=True, slots=True)
class ErrorFigures:
    """The distance of one series from another: its root mean square and its maximum."""

    rms: float
    maximum: float


def error_of(
    series: Series, truth: Series, *, is_angle: bool
) -> tuple[Series, ErrorFigures | None]:
    """Return measured minus true values, where both are known, and their statistics."""
    error = Series()
    for time_s, value in zip(series.times_s, series.values, strict=True):
        true = truth.at(time_s)
        if true is not None:
            error.add(time_s, turn(value - true) if is_angle else value - true)
    if not error:
        return error, None
    mean_square = sum(value * value for value in error.values) / len(error.values)
    return error, ErrorFigures(math.sqrt(mean_square), max(map(abs, error.values)))
