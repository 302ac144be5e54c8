"""An aircraft's response to a step: rise time, overshoot, settling time."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from itertools import accumulate
from statistics import fmean, median

from up.errors import UserError

MIN_SAMPLES = 10
SETTLED_SHARE = 0.05
TAIL_SHARE = 0.25
"""The last quarter of the window gives the final value of the response."""
LEAD_S = 0.2
"""This time before the step gives the initial value of the response."""
MIN_TRAVEL_SHARE = 0.1
"""A response below this part of the demanded step did not follow: it is measured by the demand."""
STILL_SHARE = 0.01
SMOOTHING_SHARE = 0.15
"""The mean that takes out noise is this part of the rise wide: it lengthens the rise by 1 %."""


class StepError(UserError):
    """These samples hold no step response."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Shape:
    """A curve normalised to its travel: 0 at its beginning, 1 at rest."""

    final: float
    rise_time_s: float | None
    """From 10 to 90 % of the way."""
    overshoot_percent: float
    settling_time_s: float | None
    """After this it stays within 5 % of the way from ``final``; ``None``: it rings or drifts."""
    swings: int
    """How often it crossed ``final`` after it first reached it and overshot by more than 5 %."""

    @classmethod
    def of(
        cls,
        after_s: Sequence[float],
        curve: Sequence[float],
        begin: float,
        start: float,
        end: float,
    ) -> _Shape:
        final = fmean(curve[-max(3, math.ceil(TAIL_SHARE * len(curve))) :])
        asked = end - start
        follows = (final - begin) / asked >= MIN_TRAVEL_SHARE
        way = final - begin if follows else asked
        parts = [(value - begin) / way for value in curve]
        greatest = max(parts)
        low_s, high_s = _reached_s(after_s, parts, 0.1), _reached_s(after_s, parts, 0.9)
        return cls(
            final=final,
            rise_time_s=None if low_s is None or high_s is None else high_s - low_s,
            overshoot_percent=max(0.0, 100 * (greatest - 1)),
            settling_time_s=_settled_s(after_s, parts),
            swings=_swings(parts),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class StepResponse(_Shape):
    """The figures of one step, in the unit of the values; times are seconds after the step.

    Rise, overshoot and settling are relative to the travel of the response itself, from ``begin``
    to ``final``; ``steady_error`` is its final error to the demand. A time is ``None`` if the
    event never occurs.
    """

    begin: float
    steady_error: float
    """Demand less ``final``."""
    steady_error_percent: float
    """The same in parts of the step: positive falls short, negative overshoots."""


def analyse_step(
    times_s: Sequence[float],
    values: Sequence[float],
    at_s: float,
    start: float,
    end: float,
    until_s: float | None = None,
) -> StepResponse:
    """Measure the response of ``values`` to a demand stepped from ``start`` to ``end`` at ``at_s``.

    Samples after ``until_s`` are ignored. Single outliers and noise are removed first. Raises
    ``StepError`` where there is nothing to measure.
    """
    _check(times_s, values, at_s, start, end, until_s)
    first = bisect_left(times_s, at_s)
    past = len(times_s) if until_s is None else bisect_left(times_s, until_s + 1e-9)
    if past - first < MIN_SAMPLES:
        raise StepError(
            f"only {max(0, past - first)} samples after the step at {at_s:g} s:"
            f" {MIN_SAMPLES} are needed",
            "too_few_samples",
        )
    lead = bisect_left(times_s, at_s - LEAD_S)
    after_s = [time_s - at_s for time_s in times_s[first:past]]
    before = _without_spikes(values[lead:first])
    begin = fmean(before) if before else start
    curve = _without_spikes(values[first:past])
    if max(curve) - min(curve) < STILL_SHARE * abs(end - start) and (
        abs(fmean(curve) - begin) < STILL_SHARE * abs(end - start)
    ):
        raise StepError(f"the values do not move after the step at {at_s:g} s", "no_response")

    rough = _Shape.of(after_s, curve, begin, start, end)
    width_s = SMOOTHING_SHARE * (rough.rise_time_s or 0.0)
    shape = _Shape.of(after_s, _smoothed(after_s, curve, width_s), begin, start, end)
    return StepResponse(
        **asdict(shape),
        begin=begin,
        steady_error=end - shape.final,
        steady_error_percent=100 * (end - shape.final) / (end - start),
    )


def _check(
    times_s: Sequence[float],
    values: Sequence[float],
    at_s: float,
    start: float,
    end: float,
    until_s: float | None,
) -> None:
    for name, number in (("at_s", at_s), ("start", start), ("end", end), ("until_s", until_s)):
        if number is not None and not math.isfinite(number):
            raise StepError(f"{name} is not a finite number: {number}", "not_finite")
    if not math.isfinite(end - start) or abs(end - start) < 1e-9:
        raise StepError(f"{start:g} to {end:g} is not a step", "no_step")
    for index, (time_s, value) in enumerate(zip(times_s, values, strict=True)):
        if not (math.isfinite(time_s) and abs(value) < 1e12):
            raise StepError(
                f"sample {index} at {time_s:g} s is not a finite number: {value}", "not_finite"
            )
        if index and time_s <= times_s[index - 1]:
            text = f"the time of sample {index} ({time_s:g} s) does not rise"
            raise StepError(text, "times_not_rising")


def _without_spikes(values: Sequence[float]) -> list[float]:
    """Return the running median of five: it removes spikes of one or two samples."""
    if len(values) < 5:
        return list(values)
    middle = [median(values[at - 2 : at + 3]) for at in range(2, len(values) - 2)]
    return [values[0], median(values[0:3]), *middle, median(values[-3:]), values[-1]]


def _smoothed(after_s: Sequence[float], curve: Sequence[float], width_s: float) -> list[float]:
    """Return the running mean of ``width_s``, centred, so that it adds no delay."""
    sums = [0.0, *accumulate(curve)]
    smooth = []
    low = high = 0
    for at, time_s in enumerate(after_s):
        while after_s[low] < time_s - width_s / 2:
            low += 1
        while high < len(after_s) and after_s[high] <= time_s + width_s / 2:
            high += 1
        # The same number on either side, or the mean leans at the ends.
        reach = min(at - low, high - 1 - at)
        smooth.append((sums[at + reach + 1] - sums[at - reach]) / (2 * reach + 1))
    return smooth


def _reached_s(after_s: Sequence[float], parts: Sequence[float], level: float) -> float | None:
    """Return when the curve first reaches ``level``, between two samples."""
    for at, part in enumerate(parts):
        if part >= level:
            if at == 0:
                return after_s[0]
            share = (level - parts[at - 1]) / (part - parts[at - 1])
            return after_s[at - 1] + share * (after_s[at] - after_s[at - 1])
    return None


def _settled_s(after_s: Sequence[float], parts: Sequence[float]) -> float | None:
    """Return after when the curve stays within 5 %, ``None`` where the tail still leaves it."""
    last_out = -1
    for at in range(len(parts) - 1, -1, -1):
        if abs(parts[at] - 1) > SETTLED_SHARE:
            last_out = at
            break
    if last_out < 0:
        return after_s[0]
    if last_out >= len(parts) - max(3, math.ceil(TAIL_SHARE * len(parts))):
        return None
    inside, outside = abs(parts[last_out + 1] - 1), abs(parts[last_out] - 1)
    share = (outside - SETTLED_SHARE) / (outside - inside)
    return after_s[last_out] + share * (after_s[last_out + 1] - after_s[last_out])


def _swings(parts: Sequence[float]) -> int:
    """Return how many times the curve went more than 5 % beyond, now on one side, now the other."""
    swings = 0
    side = -1
    for part in parts:
        now = 1 if part > 1 + SETTLED_SHARE else -1 if part < 1 - SETTLED_SHARE else side
        if now != side:
            swings += 1
            side = now
    return swings
