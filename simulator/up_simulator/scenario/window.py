"""The part of a flight's log that an expectation evaluates."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from up_simulator.scenario.expectation import Expectation
from up_simulator.scenario.log import FlightLog, Value

_SLACK_S = 1e-6
_TURNING = ("yaw_deg", "track_deg", "heading.actual", "heading.required", "home.bearing")
"""Signals that wrap: 359 and 1 are two degrees apart."""


class NoWindowError(Exception):
    """The flight does not reach the window.

    ``code`` is ``no_signal``, ``event_missing`` or ``window_missing``; the message names it.
    """

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.code = code


@dataclass(frozen=True, slots=True)
class Window:
    """Times and values of one signal from ``begin_s`` to ``end_s``; ``is_cut``: the log ends first.

    Values that are not known are NaN or an empty text.
    """

    begin_s: float
    end_s: float
    times_s: Sequence[float]
    values: Sequence[Value]
    is_cut: bool

    @property
    def numbers(self) -> list[float]:
        """Return the values as numbers, NaN for a text."""
        return [value if isinstance(value, float) else math.nan for value in self.values]

    def unknown_s(self) -> float | None:
        """Return the first time without a known value."""
        for time_s, value in zip(self.times_s, self.values, strict=True):
            if value == "" or value != value:
                return time_s
        return None

    def steady(self) -> Window:
        turns = 0.0
        before: float | None = None
        values: list[Value] = []
        for value in self.numbers:
            if before is not None and abs(value - before) > 180.0:
                turns += 360.0 if value < before else -360.0
            before = value if math.isfinite(value) else before
            values.append(value + turns)
        return Window(self.begin_s, self.end_s, self.times_s, values, self.is_cut)


def window_of(
    expectation: Expectation, log: FlightLog, event_times: Mapping[str, float], duration_s: float
) -> Window:
    """Return the window; raises NoWindowError where the log has no row or column of it."""
    if expectation.signal not in log:
        text = f"the log has no {expectation.signal}: that part was not aboard"
        raise NoWindowError("no_signal", text)
    offset_s = 0.0
    if expectation.after:
        if expectation.after not in event_times:
            text = f"the flight ended before '{expectation.after}'"
            raise NoWindowError("event_missing", text)
        offset_s = event_times[expectation.after]
    begin_s = offset_s + expectation.from_s
    end_s = duration_s if expectation.to_s is None else offset_s + expectation.to_s
    times_s = log.numbers("time_s")
    first = bisect_left(times_s, begin_s - _SLACK_S)
    past = bisect_right(times_s, end_s + _SLACK_S)
    if first >= past:
        newest = f"{times_s[-1]:.2f} s" if times_s else "its first row"
        text = f"the flight ended at {newest}, before the window begins"
        raise NoWindowError("window_missing", text)
    values = log.column(expectation.signal)[first:past]
    # The last row of a whole flight is up to 20 ms before its end.
    is_cut = past == len(times_s) and times_s[-1] < end_s - 0.021
    window = Window(begin_s, end_s, times_s[first:past], values, is_cut)
    return window.steady() if expectation.signal.endswith(_TURNING) else window
