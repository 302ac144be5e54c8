"""Searches the gains of an axis: the fastest that keep their margins at cruise and in a dive."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from tools.tuning.evaluation import Loop, Rules, try_loop, worst
from tools.tuning.experiments import (
    STEPS,
    Bench,
    FlownSteps,
    RoughFlight,
    fly_rough,
    fly_steps,
    yaw_swing,
)
from tools.tuning.gain_set import Axis, AxisGains, axis_gains, with_axis
from tools.tuning.margins import Margins
from up.commands.gains import Gains, GainSet
from up.errors import UserError
from up_simulator.aircraft import Weather
from up_simulator.harness.user_log import Log, no_log
from up_simulator.harness.workers import Workers

STABILIZE_P = (2.0, 3.0, 4.0, 5.0, 6.0, 8.0)
QUICK_STABILIZE_P = (4.0, 8.0)
SHARES_OF_MAX = (1.0, 0.85, 0.7, 0.55, 0.4)
QUICK_SHARES_OF_MAX = (0.85, 0.5)
I_OF_P = (0.5, 1.0, 2.0)
YAW_P = (0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0)
QUICK_YAW_P = (0.0, 2.0, 4.0)
ROOM_FOR_I = 0.93
"""An integral part spends a little phase: the P beside it gives way."""
MAX_RATE_P = 20.0
GENTLE_SENSITIVITY = 3.5
"""A loop that is measured with a peak beyond this is measured again with half the gains."""
DIVE_FACTOR = 1.6
"""The airspeed of the dive counts as at least this multiple of cruise."""
NEARLY_AS_GOOD = 1.1
WORTH_AN_INTEGRAL = 0.75
HALF = 0.5
ROUGH_S = 15.0


class TuneError(UserError):
    """No gains can be proposed."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """Gains of one axis, their measurements, and the rules that they break."""

    gains: AxisGains
    cruise: Margins
    dive: Margins
    steps: FlownSteps
    broken: tuple[str, ...]

    @property
    def score(self) -> float:
        """Return its score, s: the settling time, longer by the error at the end."""
        settling_s = self.steps.settling_time_s
        if settling_s is None:
            return math.inf
        return settling_s * (1 + self.steps.steady_error_percent / 20)


@dataclass(frozen=True, slots=True)
class AxisTuning:
    """The candidates for an axis, the proposal among them, and the loops that judged them."""

    axis: Axis
    candidates: tuple[Candidate, ...]
    proposal: Candidate
    now: Candidate
    """With the gains that it had before."""
    cruise: Loop
    dive: Loop

    @property
    def keeps_the_rules(self) -> bool:
        return not self.proposal.broken


@dataclass(frozen=True, slots=True)
class YawTuning:
    """The swing that is left of a kick of the rudder, for each gain of the damper."""

    swings: tuple[tuple[float, float], ...]
    proposal: float


def tune_axis(
    bench: Bench,
    gains: GainSet,
    axis: Axis,
    workers: Workers,
    *,
    rules: Rules | None = None,
    loops: tuple[Loop, Loop] | None = None,
    is_quick: bool = False,
    log: Log = no_log,
) -> AxisTuning:
    """Return the best gains for roll or pitch; the other axes keep their gains.

    ``loops`` of the axis, at cruise and in the dive, are measured if they are not given. Raises
    ``TuneError``.
    """
    rules = rules or Rules()
    cruise, dive = loops or measure_loops(bench, gains, axis, workers, log)
    tried = [
        each
        for each in _grid(cruise, dive, rules, is_quick)
        if not _broken_margins(rules, *_margins(cruise, dive, each))
    ]
    if not tried:
        raise TuneError(f"{axis}: no gains keep the margins, whatever they are", "no_margins")
    log(f"{axis}: {len(tried)} sets of gains keep their margins; flying steps with each")
    candidates = _fly(bench, gains, axis, tried, (cruise, dive), rules, workers)
    best = choose(candidates)
    if not is_quick:
        rate = best.gains.rate
        more = [
            AxisGains(
                Gains(_round(ROOM_FOR_I * rate.p), _round(part * rate.p)), best.gains.stabilize
            )
            for part in I_OF_P
        ]
        with_integral = _fly(bench, gains, axis, more, (cruise, dive), rules, workers)
        candidates += with_integral
        better = choose(with_integral)
        if _rank(better) < _rank(best) and better.score < WORTH_AN_INTEGRAL * best.score:
            best = better
    own = [axis_gains(gains, axis)]
    (now,) = _fly(bench, gains, axis, own, (cruise, dive), rules, workers)
    return AxisTuning(axis, tuple(candidates), best, now, cruise, dive)


def tune_yaw(
    bench: Bench, gains: GainSet, workers: Workers, *, is_quick: bool = False
) -> YawTuning | None:
    """Return the best yaw damper; ``None`` where the rudder has no effect.

    It is the weakest one that halves the swing without a damper: a damper works against every
    turn, and shakes the rudder.
    """
    grid = QUICK_YAW_P if is_quick else YAW_P
    sets = [with_axis(gains, "yaw", AxisGains(Gains(each), Gains(0.0))) for each in grid]
    swings = workers.fly(yaw_swing, [(bench, each) for each in sets])
    if max(swings) < 0.5 or max(swings) - min(swings) < 0.05 * max(swings):
        return None
    enough = max(min(swings), HALF * swings[0])
    weakest = next(gain for gain, swing in zip(grid, swings, strict=True) if swing <= enough)
    return YawTuning(tuple(zip(grid, swings, strict=True)), weakest)


@dataclass(frozen=True, slots=True)
class RoughAir:
    """How two sets of gains hold the aircraft in rough air: as it was, and as proposed."""

    steps: tuple[tuple[Axis, FlownSteps], ...]
    """Steps of the proposal in light turbulence."""
    was: RoughFlight
    proposed: RoughFlight


def try_rough_air(
    bench: Bench,
    was: GainSet,
    proposed: GainSet,
    axes: Sequence[Axis],
    workers: Workers,
    *,
    is_quick: bool = False,
) -> RoughAir:
    """Fly the proposal's steps in light turbulence, and both sets level in moderate."""
    light = Weather(turbulence="light")
    plans = [STEPS[axis] for axis in axes if axis != "yaw"]
    steps = workers.fly(fly_steps, [(bench, proposed, plan, light) for plan in plans])
    seeds = (1,) if is_quick else (1, 2, 3)
    before, after = workers.fly(
        fly_rough, [(bench, each, ROUGH_S, seeds) for each in (was, proposed)]
    )
    return RoughAir(
        tuple((plan.axis, flown) for plan, flown in zip(plans, steps, strict=True)), before, after
    )


def choose(candidates: Sequence[Candidate]) -> Candidate:
    """Return the one that keeps most rules and settles fastest; of nearly equals the calmest."""
    best = min(candidates, key=_rank)
    near = [
        each
        for each in candidates
        if len(each.broken) == len(best.broken) and each.score <= NEARLY_AS_GOOD * best.score
    ]
    calmest = [best, *near]
    return min(
        calmest, key=lambda each: max(each.cruise.peak_sensitivity, each.dive.peak_sensitivity)
    )


def _rank(candidate: Candidate) -> tuple[int, float]:
    return len(candidate.broken), candidate.score


def measure_loops(
    bench: Bench, gains: GainSet, axis: Axis, workers: Workers, log: Log = no_log
) -> tuple[Loop, Loop]:
    """Return the loop at cruise and in the dive, measured with gains that do not ring.

    The dive is 1.6 times as fast as cruise at least.

    Raises ``TuneError``.
    """
    own = axis_gains(gains, axis)
    if own.rate.p <= 0:
        own = AxisGains(Gains(1.0), Gains(4.0))
    own = AxisGains(Gains(own.rate.p), Gains(max(1.0, own.stabilize.p)))
    reason = ""
    for _ in range(5):
        sets = with_axis(gains, axis, own)
        log(f"{axis}: measuring the loop at cruise and in a dive with {own}")
        cruise, dive = workers.fly(
            try_loop, [(bench, sets, axis, own, dives) for dives in (False, True)]
        )
        if isinstance(cruise, Loop) and isinstance(dive, Loop):
            calm = max(cruise.margins().peak_sensitivity, dive.margins().peak_sensitivity)
            if calm <= GENTLE_SENSITIVITY:
                # Soft gains of the other axes must not make a gentle dive of it.
                return cruise, dive.at_least(DIVE_FACTOR * cruise.airspeed_m_s)
            reason = "it rings"
        else:
            reason = next(each for each in (cruise, dive) if isinstance(each, str))
        own = AxisGains(Gains(own.rate.p / 2), own.stabilize)
    raise TuneError(f"{axis}: {reason}", "not_measurable")


def _grid(cruise: Loop, dive: Loop, rules: Rules, is_quick: bool) -> list[AxisGains]:
    """Return pairs of gains below the greatest rate P that each stabilize P leaves."""
    found = []
    for stabilize in QUICK_STABILIZE_P if is_quick else STABILIZE_P:
        most = _most_rate_p(cruise, dive, rules, stabilize)
        for part in QUICK_SHARES_OF_MAX if is_quick else SHARES_OF_MAX:
            rate = _round(part * most)
            if rate > 0:
                found.append(AxisGains(Gains(rate), Gains(stabilize)))
    return found


def _most_rate_p(cruise: Loop, dive: Loop, rules: Rules, stabilize: float) -> float:
    """Return the greatest rate P that keeps the margins, found by halving."""
    low, high = 0.0, MAX_RATE_P
    for _ in range(10):
        middle = (low + high) / 2
        gains = AxisGains(Gains(middle), Gains(stabilize))
        if _broken_margins(rules, *_margins(cruise, dive, gains)):
            high = middle
        else:
            low = middle
    return low


def _margins(cruise: Loop, dive: Loop, gains: AxisGains) -> tuple[Margins, Margins]:
    return cruise.margins(gains), dive.margins(gains)


def _broken_margins(rules: Rules, cruise: Margins, dive: Margins) -> list[str]:
    return rules.broken_by_margins(worst((cruise, dive)))


def _fly(
    bench: Bench,
    gains: GainSet,
    axis: Axis,
    tried: Sequence[AxisGains],
    loops: tuple[Loop, Loop],
    rules: Rules,
    workers: Workers,
) -> list[Candidate]:
    sets = [with_axis(gains, axis, each) for each in tried]
    flown = workers.fly(fly_steps, [(bench, each, STEPS[axis]) for each in sets])
    candidates = []
    for each, steps in zip(tried, flown, strict=True):
        cruise, dive = _margins(*loops, each)
        broken = (*_broken_margins(rules, cruise, dive), *rules.broken_by_steps(steps))
        candidates.append(Candidate(each, cruise, dive, steps, broken))
    return candidates


def _round(gain: float) -> float:
    """Round to two digits: a user sets no more, and an aeroplane shows no difference."""
    return float(f"{gain:.2g}")
