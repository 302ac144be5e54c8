"""Everything that is measured of one axis with one set of gains, and whether it will do."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from tools.tuning.experiments import Bench, FlownSteps, measure_loop
from tools.tuning.gain_set import Axis, AxisGains
from tools.tuning.margins import LoopPoint, Margins, MarginsError, margins_of, scaled
from up.commands.gains import Gains, GainSet

D_FILTER_S = 0.007
"""The low-pass of the firmware's derivative (pid.h)."""


@dataclass(frozen=True, slots=True)
class Rules:
    """The rules for a proposal. Margins hold at cruise and in the dive, the rest at cruise."""

    gain_margin_db: float = 6.0
    phase_margin_deg: float = 45.0
    delay_margin_ms: float = 15.0
    peak_sensitivity: float = 2.0
    overshoot_percent: float = 10.0
    steady_error_percent: float = 10.0

    def broken_by_margins(self, margins: Margins) -> list[str]:
        """Return the rules that the margins break, in a few words each."""
        broken = []
        if margins.gain_margin_db is not None and margins.gain_margin_db < self.gain_margin_db:
            broken.append(f"gain margin {margins.gain_margin_db:.1f} dB")
        phase = margins.phase_margin_deg
        if phase is not None and phase < self.phase_margin_deg:
            broken.append(f"phase margin {phase:.0f} deg")
        if margins.delay_margin_ms is not None and margins.delay_margin_ms < self.delay_margin_ms:
            broken.append(f"delay margin {margins.delay_margin_ms:.0f} ms")
        if margins.peak_sensitivity > self.peak_sensitivity:
            broken.append(f"peak sensitivity {margins.peak_sensitivity:.1f}")
        return broken

    def broken_by_steps(self, steps: FlownSteps) -> list[str]:
        """Return the rules that the steps break, in a few words each."""
        broken = []
        if steps.crash is not None:
            broken.append(steps.crash)
        if steps.overshoot_percent > self.overshoot_percent:
            broken.append(f"overshoot {steps.overshoot_percent:.0f} %")
        if steps.steady_error_percent > self.steady_error_percent:
            broken.append(f"falls {steps.steady_error_percent:.0f} % short")
        if steps.settling_time_s is None:
            broken.append("does not settle")
        return broken


@dataclass(frozen=True, slots=True)
class Loop:
    """The open loop of an axis as it was measured with some gains, at an airspeed."""

    gains: AxisGains
    points: tuple[LoopPoint, ...]
    airspeed_m_s: float

    def with_gains(self, gains: AxisGains) -> list[LoopPoint]:
        """Return the loop with other gains: the board's part of it is known exactly."""
        return [
            LoopPoint(
                point.frequency_hz,
                point.response
                * compensator(gains, point.frequency_hz)
                / compensator(self.gains, point.frequency_hz),
            )
            for point in self.points
        ]

    def at_least(self, airspeed_m_s: float) -> Loop:
        """Return the loop at this airspeed, if it was measured at a lower one.

        Control forces grow with the square of the airspeed; the greater damping by the air is
        neglected, which errs to the safe side.
        """
        if self.airspeed_m_s >= airspeed_m_s:
            return self
        factor = (airspeed_m_s / self.airspeed_m_s) ** 2
        return Loop(self.gains, tuple(scaled(self.points, factor)), airspeed_m_s)

    def margins(self, gains: AxisGains | None = None) -> Margins:
        return margins_of(self.points if gains is None else self.with_gains(gains))


def compensator(gains: AxisGains, frequency_hz: float) -> complex:
    """Return the response of both controllers together to a rotation rate, 1.25 us per deg/s.

    The angle is the rate's integral; the rate that the Stabilize controller demands is minus its
    answer to the angle.
    """
    s = 2j * math.pi * frequency_hz

    def controller(terms: Gains) -> complex:
        return terms.p + terms.i / s + terms.d * s / (1 + D_FILTER_S * s)

    return controller(gains.rate) * (1 + controller(gains.stabilize) / s)


def try_loop(bench: Bench, gains: GainSet, axis: Axis, own: AxisGains, dives: bool) -> Loop | str:
    """Fly and return the loop of an axis, or why it cannot be measured."""
    try:
        points, airspeed_m_s = measure_loop(bench, gains, axis, dives=dives, periods=3)
    except MarginsError as error:
        return str(error)
    return Loop(own, tuple(points), airspeed_m_s)


def worst(margins: Sequence[Margins]) -> Margins:

    def least(name: str) -> float | None:
        known = [value for each in margins if (value := getattr(each, name)) is not None]
        return min(known, default=None)

    return Margins(
        least("gain_margin_db"),
        least("gain_margin_hz"),
        least("phase_margin_deg"),
        least("crossover_hz"),
        least("delay_margin_ms"),
        max(each.peak_sensitivity for each in margins),
    )
