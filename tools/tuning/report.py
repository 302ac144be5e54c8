"""The report of tuning: tables and sentences for a terminal."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from tools.tuning.evaluation import Rules
from tools.tuning.log_steps import ADVICE, LogStep, advice
from tools.tuning.margins import Margins
from tools.tuning.tune import AxisTuning, Candidate, RoughAir, YawTuning

MAX_ROWS = 12
WIDTH = 98


def tuning_lines(tuning: AxisTuning) -> list[str]:
    """Return the best candidates as a table, the proposal marked."""
    cruise_m_s, dive_m_s = tuning.cruise.airspeed_m_s, tuning.dive.airspeed_m_s
    lines = [
        f"{tuning.axis} in FBW, steps at cruise ({cruise_m_s:.0f} m/s); margins there and in a"
        f" dive ({dive_m_s:.0f} m/s)",
        f"    {'gains':<32} {'rise':>6} {'over':>5} {'settled':>8} {'lacks':>6}"
        f" | {'cruise':^19} | {'dive':^19}",
        f"    {'':<32} {'s':>6} {'%':>5} {'s':>8} {'%':>6}"
        f" | {'dB':>5} {'ms':>6} {'peak':>6} | {'dB':>5} {'ms':>6} {'peak':>6}",
    ]
    best = sorted(tuning.candidates, key=lambda each: (len(each.broken), each.score))
    shown = best[:MAX_ROWS]
    if tuning.proposal not in shown:
        shown[-1] = tuning.proposal
    lines.append(_row("was ", tuning.now))
    lines += [_row("->  " if each is tuning.proposal else "    ", each) for each in shown]
    if len(best) > len(shown):
        lines.append(f"    and {len(best) - len(shown)} more that are slower or break a rule")
    if tuning.proposal.broken:
        lines.append(
            f"No set keeps every rule on this axis; the one proposed breaks:"
            f" {', '.join(tuning.proposal.broken)}."
        )
    return lines


def yaw_lines(tuning: YawTuning | None) -> list[str]:
    if tuning is None:
        return ["yaw: the rudder does nothing here that a damper could use; its gain is 0"]
    swings = ", ".join(f"{gain:g}: {swing:.1f}" for gain, swing in tuning.swings)
    return [
        f"yaw damper, rate P and the swing left of a kick, deg/s rms: {swings}",
        f"    the weakest that halves it: {tuning.proposal:g}",
    ]


def rough_lines(air: RoughAir) -> list[str]:
    """Return how the proposal does where the air moves."""
    lines = []
    for axis, steps in air.steps:
        lines.append(
            f"{axis} steps of the proposal in light turbulence:"
            f" rise {_number(steps.rise_time_s, 2)} s, over {steps.overshoot_percent:.0f} %,"
            f" lacks {steps.steady_error_percent:.0f} %"
        )
    was, now = air.was, air.proposed
    lines.append(
        "level in moderate turbulence, rms, as it was -> proposed:"
        f" roll {was.roll_rms_deg:.2f} -> {now.roll_rms_deg:.2f} deg,"
        f" pitch {was.pitch_rms_deg:.2f} -> {now.pitch_rms_deg:.2f} deg,"
        f" yaw rate {was.yaw_rate_rms_deg_s:.1f} -> {now.yaw_rate_rms_deg_s:.1f} deg/s"
    )
    for words, flight in (("as it was", was), ("proposed", now)):
        if flight.crash is not None:
            lines.append(f"{words}: the aircraft {flight.crash}")
    return [row for line in lines for row in textwrap.wrap(line, WIDTH, subsequent_indent="    ")]


def rules_lines(rules: Rules) -> list[str]:
    text = (
        f"A proposal keeps, at cruise and in the dive, {rules.gain_margin_db:g} dB of gain,"
        f" {rules.phase_margin_deg:g} deg of phase, {rules.delay_margin_ms:g} ms of delay and a"
        f" peak of the sensitivity of {rules.peak_sensitivity:g}; it overshoots"
        f" {rules.overshoot_percent:g} % and lacks {rules.steady_error_percent:g} % at most. Of"
        " those that do, the fastest; of nearly equals, the calmest."
    )
    return textwrap.wrap(text, WIDTH)


def log_lines(steps: Sequence[LogStep]) -> list[str]:
    """Return the steps of a log as a table, and recommendations."""
    lines = [
        f"{'at':>8}  {'axis':<6} {'mode':<5} {'from':>6} {'to':>6} {'':<6} {'rise':>6} {'over':>5}"
        f" {'settled':>8} {'lacks':>6}",
        f"{'s':>8}  {'':<6} {'':<5} {'':>6} {'':>6} {'':<6} {'s':>6} {'%':>5} {'s':>8} {'%':>6}",
    ]
    for step in steps:
        head = (
            f"{step.at_s:>8.2f}  {step.axis:<6} {step.mode:<5} {step.start:>6.0f} {step.end:>6.0f}"
            f" {step.unit:<6}"
        )
        response = step.response
        if response is None:
            lines.append(f"{head} {step.problem}")
            continue
        lines.append(
            f"{head} {_number(response.rise_time_s, 2):>6} {response.overshoot_percent:>5.0f}"
            f" {_number(response.settling_time_s, 2):>8} {response.steady_error_percent:>6.0f}"
        )
    lines.append("")
    for (axis, mode), code in advice(steps).items():
        sentence = f"{axis} in {mode}: {ADVICE[code]}"
        lines += textwrap.wrap(sentence, WIDTH, subsequent_indent="  ")
    return lines


def _row(mark: str, candidate: Candidate) -> str:
    steps = candidate.steps
    line = (
        f"{mark}{candidate.gains!s:<32} {_number(steps.rise_time_s, 2):>6}"
        f" {steps.overshoot_percent:>5.0f} {_number(steps.settling_time_s, 2):>8}"
        f" {steps.steady_error_percent:>6.0f} | {_margins(candidate.cruise)}"
        f" | {_margins(candidate.dive)}"
    )
    return f"{line}  {candidate.broken[0]}" if candidate.broken else line


def _margins(margins: Margins) -> str:
    return (
        f"{_number(margins.gain_margin_db, 1):>5} {_number(margins.delay_margin_ms, 0):>6}"
        f" {margins.peak_sensitivity:>6.2f}"
    )


def _number(value: float | None, digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}f}"
