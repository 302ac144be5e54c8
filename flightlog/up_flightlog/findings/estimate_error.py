"""The error of the attitude used for control: known only for simulated flights."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.series import Series, columns, turn
from up_flightlog.read.source_filter import from_selected_source

TRUTH = "simulator.truth"
ORIENTATION = "up.orientation.update"
AXES = ("roll", "pitch")
_APART_S = 0.05
"""Truth and estimate reach the log with different delays; the maximum distance of a pair."""


@dataclass(frozen=True, slots=True)
class EstimateError:
    """Of one axis: root mean square and greatest error, and the time of the latter."""

    axis: str
    rms_deg: float
    worst_deg: float
    worst_s: float


def estimate_errors(log: FlightLog) -> Iterator[EstimateError]:
    """Yield those of roll and pitch; nothing if the log has no truth or no attitude."""
    if TRUTH not in log.topics or ORIENTATION not in log.topics:
        return
    samples = ((each.time_s, each.data) for each in log.messages(TRUTH))
    truth = columns(samples, [f"{axis}_deg" for axis in AXES])
    attitude = columns(from_selected_source(log, "orientation", ORIENTATION), AXES)
    for axis in AXES:
        off = _errors_deg(attitude[axis], truth[f"{axis}_deg"])
        if off:
            worst = max(range(len(off.values)), key=lambda at: off.values[at])
            rms_deg = math.sqrt(math.fsum(each * each for each in off.values) / len(off.values))
            yield EstimateError(axis, rms_deg, off.values[worst], off.times_s[worst])


def _errors_deg(estimate: Series, truth: Series) -> Series:
    """Return the difference between each estimate and the truth within ``_APART_S`` of its time."""
    found = Series()
    for time_s, value in zip(estimate.times_s, estimate.values, strict=True):
        true = [truth.at(time_s + apart_s, 0.5) for apart_s in (-_APART_S, 0.0, _APART_S)]
        off = [turn(value - each) for each in true if each is not None]
        if len(off) == len(true):
            is_between = min(off) < 0 < max(off) and max(off) - min(off) < 180
            found.add(time_s, 0.0 if is_between else min(map(abs, off)))
    return found
