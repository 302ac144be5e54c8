"""The picture of a tuning: the steps as they were and as proposed, and the open loop."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from tools.tuning.evaluation import Loop
from tools.tuning.experiments import SETTLE_S, FlownSteps
from tools.tuning.tune import AxisTuning
from up_flightlog.plots.canvas import Sheet, png_of
from up_flightlog.plots.theme import DAYLIGHT as THEME

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH_IN = 15.0
MARGIN_IN = 0.7
HEAD_IN = 1.0
BIG_IN = 2.9
DPI = 110


def draw_tuning(tuning: AxisTuning, path: Path, *, title: str) -> None:
    """Draw the proposal and the loop's response with its margins.

    Raises PictureError without matplotlib, and OSError.
    """
    paint = partial(_draw, tuning=tuning, title=title)
    path.write_bytes(png_of(paint, WIDTH_IN, HEAD_IN + BIG_IN + 0.9, DPI, THEME))


def _draw(sheet: Sheet, tuning: AxisTuning, title: str) -> None:
    sheet.text(MARGIN_IN, 0.2, title, size=15, weight="bold")
    subtitle = f"{tuning.axis} in FBW; proposed: {tuning.proposal.gains}"
    sheet.text(MARGIN_IN, 0.5, subtitle, size=9.5, color=THEME.muted)
    width = (WIDTH_IN - 2 * MARGIN_IN - 1.6) / 3
    axes = [
        sheet.axes(MARGIN_IN + number * (width + 0.8), HEAD_IN + 0.15, width, BIG_IN)
        for number in range(3)
    ]
    _draw_comparison(axes[0], tuning)
    _draw_loop(axes[1], axes[2], tuning)


def _draw_comparison(axes: Axes, tuning: AxisTuning) -> None:
    plan = tuning.proposal.steps.plan
    _demand(axes, tuning.proposal.steps, len(plan.demands))
    for candidate, colour, words in (
        (tuning.now, THEME.orange, "as it was"),
        (tuning.proposal, THEME.green, "proposed"),
    ):
        times_s, values = _shown(candidate.steps, len(plan.demands))
        axes.plot(times_s, values, color=colour, lw=1.6, label=f"{words}: {candidate.gains}")
    axes.set_title("Steps", loc="left", size=10, weight="bold")
    axes.set_xlabel("time (s)")
    axes.set_ylabel("deg")
    _room_for_legend(axes)


def _draw_loop(size_axes: Axes, phase_axes: Axes, tuning: AxisTuning) -> None:
    """Draw size and phase of the open loop with the proposed gains, and the margins."""
    curves: tuple[tuple[Loop, str, str, str], ...] = (
        (tuning.cruise, "cruise", THEME.blue, "-"),
        (tuning.dive, "dive", THEME.purple, "--"),
    )
    for loop, words, colour, style in curves:
        points = loop.with_gains(tuning.proposal.gains)
        margins = loop.margins(tuning.proposal.gains)
        hz = [point.frequency_hz for point in points]
        size_db = [20 * math.log10(max(1e-9, abs(point.response))) for point in points]
        phase = _unwrapped([point.response for point in points])
        gain = margins.gain_margin_db
        left = "no end to its gain" if gain is None else f"{gain:.1f} dB left"
        size_axes.semilogx(
            hz,
            size_db,
            color=colour,
            ls=style,
            label=f"{words} {loop.airspeed_m_s:.0f} m/s: {left}",
        )
        delay = margins.delay_margin_ms
        left = "never reaches 0 dB" if delay is None else f"{delay:.0f} ms of delay left"
        phase_axes.semilogx(hz, phase, color=colour, ls=style, label=f"{words}: {left}")
        if gain is not None and margins.gain_margin_hz is not None:
            at_hz = margins.gain_margin_hz
            size_axes.plot([at_hz, at_hz], [0, -gain], color=colour, lw=2.5, alpha=0.5)
        if margins.crossover_hz is not None:
            at_hz, phase_deg = margins.crossover_hz, margins.phase_margin_deg or 0.0
            phase_axes.plot(
                [at_hz, at_hz], [-180, phase_deg - 180], color=colour, lw=2.5, alpha=0.5
            )
    for axes, level, words, unit in (
        (size_axes, 0.0, "Open loop: gain around the loop", "dB"),
        (phase_axes, -180.0, "Its phase", "deg"),
    ):
        axes.axhline(level, color=THEME.ink, lw=0.8)
        axes.set_title(words, loc="left", size=10, weight="bold")
        axes.set_xlabel("frequency (Hz)")
        axes.set_ylabel(unit)
        axes.xaxis.set_major_formatter("{x:g}")
        _room_for_legend(axes)


def _demand(axes: Axes, steps: FlownSteps, count: int) -> None:
    plan = steps.plan
    times_s, values = [-0.5, 0.0], [0.0, 0.0]
    for number, demand in enumerate(plan.demands[:count]):
        times_s += [number * plan.hold_s, (number + 1) * plan.hold_s]
        values += [demand, demand]
    axes.plot(times_s, values, color=THEME.ink, ls=":", lw=1.2)
    axes.axhline(0, color=THEME.grid, lw=0.6)


def _shown(steps: FlownSteps, count: int) -> tuple[list[float], list[float]]:
    end_s = SETTLE_S + count * steps.plan.hold_s
    recording = steps.recording
    pairs = [
        (time_s - SETTLE_S, value)
        for time_s, value in zip(recording.times_s, recording[steps.plan.signal], strict=True)
        if SETTLE_S - 0.5 <= time_s <= end_s
    ]
    return [time_s for time_s, _ in pairs], [value for _, value in pairs]


def _unwrapped(responses: Sequence[complex]) -> list[float]:
    phases: list[float] = []
    for response in responses:
        phase = math.degrees(cmath.phase(response))
        if phases:
            phase += 360 * round((phases[-1] - phase) / 360)
        phases.append(phase)
    return phases


def _room_for_legend(axes: Axes) -> None:
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.22 * (high - low))
    axes.legend(loc="upper right", borderaxespad=0.2)
