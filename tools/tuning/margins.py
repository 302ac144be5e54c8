"""The stability margins of a control loop, from its measured frequency response."""

from __future__ import annotations

import cmath
import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from statistics import fmean

from up.errors import UserError

MAX_SPREAD = 0.35
"""The periods of a measurement agree within this part, or the frequency is left out."""
MAX_OWN_SHARE = 0.7
"""A servo that moves more than this part at unexcited frequencies oscillates on its own."""


class MarginsError(UserError):
    """The loop cannot be judged from this."""


@dataclass(frozen=True, slots=True)
class Multisine:
    """Sines of equal amplitude at chosen whole numbers of cycles in a period.

    Their phases are those of Schroeder (1970): the sum stays small. Times are seconds from the
    first step of the excitation.
    """

    period_s: float = 8.0
    amplitude_us: float = 6.0
    cycles: tuple[int, ...] = (
        *(2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 19, 22, 25, 28, 31, 34, 38, 42, 46, 51, 56),
        *(62, 68, 75, 83, 92, 102, 112, 124, 137, 151),
    )

    def at(self, time_s: float) -> float:
        turn = 2 * math.pi * time_s / self.period_s
        count = len(self.cycles)
        return self.amplitude_us * sum(
            math.cos(turn * cycle - math.pi * at * (at - 1) / count)
            for at, cycle in enumerate(self.cycles, 1)
        )

    @property
    def frequencies_hz(self) -> list[float]:
        return [cycle / self.period_s for cycle in self.cycles]


@dataclass(frozen=True, slots=True)
class LoopPoint:
    """The loop's response at a frequency: output over input once around, with its sign."""

    frequency_hz: float
    response: complex


def loop_response(
    given: Sequence[float], moved: Sequence[float], multisine: Multisine, step_s: float
) -> list[LoopPoint]:
    """Return the open loop, cut between board and servo, at the frequencies of the excitation.

    ``given`` is the board's output to an axis and ``moved`` the input of its servos, with the
    excitation: both from whole periods, without the first one, in which the flight settles into
    the oscillation. A frequency at which the periods do not agree is left out. Raises
    ``MarginsError``.
    """
    period = round(multisine.period_s / step_s)
    periods = len(moved) // period
    if periods < 3 or len(given) != len(moved):
        text = "three whole periods of excitation are needed to measure a loop"
        raise MarginsError(text, "too_short")
    last = slice((periods - 1) * period, periods * period)
    if _own_share(_level(moved[last], _slope(moved, last)), multisine) > MAX_OWN_SHARE:
        raise MarginsError("the loop oscillates, or the air is rough", "oscillates")
    parts = [slice(number * period, (number + 1) * period) for number in range(1, periods)]
    came_level = [_level(given[part], _slope(given, part)) for part in parts]
    went_level = [_level(moved[part], _slope(moved, part)) for part in parts]
    points = []
    for cycle, frequency_hz in zip(multisine.cycles, multisine.frequencies_hz, strict=True):
        turns = [cmath.exp(-2j * math.pi * cycle * at / period) for at in range(period)]
        pairs = [
            (_at(came, turns), _at(went_in, turns))
            for came, went_in in zip(came_level, went_level, strict=True)
        ]
        if any(abs(went_in) < 1e-9 for _, went_in in pairs):
            raise MarginsError(f"the servos were not moved at {frequency_hz:g} Hz", "not_excited")
        single = [-came / went_in for came, went_in in pairs]
        mean = -sum(came for came, _ in pairs) / sum(went_in for _, went_in in pairs)
        spread = max(abs(each - mean) for each in single) / max(abs(mean), 1e-9)
        if spread <= MAX_SPREAD:
            points.append(LoopPoint(frequency_hz, mean))
    if all(abs(point.response) < 1e-6 for point in points):
        raise MarginsError("no response: the axis has no gains, or no servo", "no_response")
    if len(points) < len(multisine.cycles) / 2:
        text = "the loop cannot be measured: the air or the flight is too rough"
        raise MarginsError(text, "too_rough")
    return points


def _slope(values: Sequence[float], part: slice) -> float:
    """Return the drift of values in a step, about a period: sines have no part in its means."""
    period: int = part.stop - part.start
    before = values[part.start - period : part.start]
    now = values[part]
    return (fmean(now) - fmean(before)) / period


def _level(values: Sequence[float], slope: float) -> list[float]:
    """Return values less their mean and their drift."""
    middle = fmean(values)
    half = (len(values) - 1) / 2
    return [value - middle - slope * (at - half) for at, value in enumerate(values)]


def _own_share(values: Sequence[float], multisine: Multisine) -> float:
    """Return which part of a period's movement is at frequencies that the excitation has not."""
    whole = fmean([value * value for value in values])
    asked = 0.0
    for cycle in multisine.cycles:
        turn = -2j * math.pi * cycle / len(values)
        turns = [cmath.exp(turn * at) for at in range(len(values))]
        asked += 2 * abs(_at(values, turns)) ** 2
    return float(1 - asked / max(whole, 1e-12))


def _at(values: Sequence[float], turns: Sequence[complex]) -> complex:
    return sum(value * turn for value, turn in zip(values, turns, strict=True)) / len(values)


@dataclass(frozen=True, slots=True)
class Margins:
    """Margins before the loop oscillates without end; ``None``: unlimited.

    The gain margin is the factor by which airspeed (its square), a steeper servo horn or a lighter
    wing may raise all gains of the axis together; the delay margin is the delay that a slower
    servo, receiver or program may add. The peak sensitivity combines both: how much the loop
    amplifies a disturbance at worst; 1.4 is calm, 2 the usual limit, and much beyond 2 it rings.
    """

    gain_margin_db: float | None
    gain_margin_hz: float | None
    """Where it rings when the gain is raised."""
    phase_margin_deg: float | None
    crossover_hz: float | None
    """Where the loop hands over from following to not following: its bandwidth."""
    delay_margin_ms: float | None
    peak_sensitivity: float


def margins_of(points: Sequence[LoopPoint]) -> Margins:
    """Return the margins of a loop whose open loop response is known at rising frequencies.

    Between two points logarithm of size and phase go straight. Raises ``MarginsError``.
    """
    if len(points) < 4:
        text = f"{len(points)} frequencies are too few to judge a loop by"
        raise MarginsError(text, "too_few_points")
    fine = list(_between(points))
    gain_db, gain_hz = None, None
    phase_deg, phase_hz, delay_ms = None, None, None
    for (hz, size_db, angle), (next_hz, next_db, next_angle) in itertools.pairwise(fine):
        middle_hz, middle_db = math.sqrt(hz * next_hz), (size_db + next_db) / 2
        # Where the phase passes 180 degrees, or an odd multiple of it, and the loop is below 1.
        turns = math.floor((angle + 180) / 360) != math.floor((next_angle + 180) / 360)
        if turns and middle_db <= 0 and (gain_db is None or -middle_db < gain_db):
            gain_db, gain_hz = -middle_db, middle_hz
        if (size_db >= 0) != (next_db >= 0):
            middle = (angle + next_angle) / 2
            left = min(middle + 180, 180 - middle)
            if phase_deg is None or left < phase_deg:
                phase_deg, phase_hz = left, middle_hz
            late_ms = (middle + 180) % 360 / 360 / middle_hz * 1000
            delay_ms = late_ms if delay_ms is None else min(delay_ms, late_ms)
    if phase_deg is not None and phase_deg <= 0:
        gain_db, gain_hz, delay_ms = _excess(fine), None, 0.0
    peak = max(
        1 / max(1e-6, abs(1 + cmath.rect(10 ** (size_db / 20), math.radians(angle))))
        for _, size_db, angle in fine
    )
    return Margins(gain_db, gain_hz, phase_deg, phase_hz, delay_ms, peak)


def _excess(fine: Sequence[tuple[float, float, float]]) -> float:
    """Return the gain margin, below zero, of a loop that rings: the excess of its gain."""
    above = [
        size_db
        for (_, size_db, angle), (_, _, next_angle) in itertools.pairwise(fine)
        if angle >= -180 > next_angle and size_db > 0
    ]
    return -min(above, default=0.0)


def scaled(points: Sequence[LoopPoint], factor: float) -> list[LoopPoint]:
    return [LoopPoint(point.frequency_hz, factor * point.response) for point in points]


STEPS_BETWEEN = 24


def _between(points: Sequence[LoopPoint]) -> Iterator[tuple[float, float, float]]:
    """Yield frequency, size in dB and unwrapped phase in degrees, closely spaced."""
    before: float | None = None
    curve = []
    for point in points:
        angle = math.degrees(cmath.phase(point.response))
        if before is not None:
            angle += 360 * round((before - angle) / 360)
        before = angle
        curve.append((point.frequency_hz, 20 * math.log10(max(1e-9, abs(point.response))), angle))
    # A turn is free: take the one in which the loop hands over between -300 and 60 degrees.
    over = [angle for _, size_db, angle in curve if size_db >= 0]
    anchor = over[-1] if over else max(curve, key=lambda each: each[1])[2]
    shift = 360 * math.floor((60 - anchor) / 360)
    curve = [(hz, size_db, angle + shift) for hz, size_db, angle in curve]
    for (hz, size_db, angle), (next_hz, next_db, next_angle) in itertools.pairwise(curve):
        for step in range(STEPS_BETWEEN):
            share = step / STEPS_BETWEEN
            yield (
                hz * (next_hz / hz) ** share,
                size_db + share * (next_db - size_db),
                angle + share * (next_angle - angle),
            )
    yield curve[-1]
