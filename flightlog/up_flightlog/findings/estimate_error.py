"""The error of the attitude used for control: known only for simulated flights."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from up_flightlog.read.series import Series, turn

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


def estimate_errors(
    attitude: Mapping[str, Series], truth: Mapping[str, Series]
) -> Iterator[EstimateError]:
    """Yield those of roll and pitch; nothing without truth or attitude."""
    for axis in AXES:
        off = _errors_deg(attitude[axis], truth[axis])
        if off:
            worst = max(range(len(off.values)), key=lambda at: off.values[at])
            rms_deg = math.sqrt(math.fsum(each * each for each in off.values) / len(off.values))
            yield EstimateError(axis, rms_deg, off.values[worst], off.times_s[worst])


def _errors_deg(estimate: Series, truth: Series) -> Series:
    """Return the difference between each estimate and the truth within ``_APART_S`` of its time."""
    found = Series()
    for time_s, value in zip(estimate.times_s, estimate.values, strict=True):
        before = truth.at(time_s - _APART_S)
        now = truth.at(time_s)
        after = truth.at(time_s + _APART_S)
        if before is None or now is None or after is None:
            continue
        off = (turn(value - before), turn(value - now), turn(value - after))
        low, high = min(off), max(off)
        is_between = low < 0 < high and high - low < 180
        found.add(time_s, 0.0 if is_between else min(map(abs, off)))
    return found
