"""Pictures of step responses: one small panel each, so that the eye compares them."""

from __future__ import annotations

import cmath
import itertools
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from tools.tuning.evaluation import Loop
from tools.tuning.experiments import SETTLE_S, FlownSteps
from tools.tuning.log_steps import LogStep
from tools.tuning.tune import AxisTuning, Candidate
from up_simulator.picture.canvas import PictureError, Sheet, sheet_for
from up_simulator.picture.palette import (
    BLUE,
    DEMAND,
    FAULT,
    GREEN,
    GRID,
    INK,
    MUTED,
    ORANGE,
    PURPLE,
)
from up_simulator.picture.series import Log
from up_simulator.scenario.step_response import StepResponse

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH_IN = 15.0
MARGIN_IN = 0.7
HEAD_IN = 1.0
COLUMNS = 5
CELL_WIDTH_IN, CELL_HEIGHT_IN = 2.45, 1.25
GAP_WIDTH_IN, GAP_HEIGHT_IN = 0.35, 0.62
BIG_IN = 2.9
MAX_CELLS = 40
SHOWN_STEPS = 2


def draw_tuning(tuning: AxisTuning, path: Path, *, title: str) -> None:
    """Draw the proposal, the loop's response with its margins, and all candidates.

    Raises ``PictureError``.
    """
    rows = _rows(tuning.candidates)
    with sheet_for(path) as sheet:
        grid_top = HEAD_IN + BIG_IN + 1.45
        sheet.resize(WIDTH_IN, grid_top + len(rows) * (CELL_HEIGHT_IN + GAP_HEIGHT_IN))
        sheet.text(MARGIN_IN, 0.2, title, size=15, weight="bold")
        sheet.text(
            MARGIN_IN,
            0.5,
            f"{tuning.axis} in FBW; proposed: {tuning.proposal.gains}",
            size=9.5,
            color=MUTED,
        )
        width = (WIDTH_IN - 2 * MARGIN_IN - 1.6) / 3
        axes = [
            sheet.axes(MARGIN_IN + number * (width + 0.8), HEAD_IN + 0.15, width, BIG_IN)
            for number in range(3)
        ]
        _draw_comparison(axes[0], tuning)
        _draw_loop(axes[1], axes[2], tuning)
        sheet.text(
            MARGIN_IN,
            grid_top - 0.6,
            "All that were tried (green: proposed, blue: keeps the rules, grey: does not):"
            " rise and settling in s, overshoot",
            size=9.5,
            color=MUTED,
        )
        for number, row in enumerate(rows):
            for column, candidate in enumerate(row):
                cell = _cell(sheet, number * COLUMNS + column, grid_top)
                _draw_candidate(cell, candidate, tuning)


def _rows(candidates: Sequence[Candidate]) -> list[list[Candidate]]:
    """Return a row for each stabilize P, by rate P, and those with an integral part last."""
    ordered = sorted(
        candidates,
        key=lambda each: (each.gains.rate.i > 0, each.gains.stabilize.p, tuple(each.gains.rate)),
    )
    rows = []
    for _, group in itertools.groupby(
        ordered, lambda each: (each.gains.rate.i > 0, each.gains.stabilize.p)
    ):
        row = list(group)
        rows += [row[at : at + COLUMNS] for at in range(0, len(row), COLUMNS)]
    return rows


def draw_log_steps(
    log: Log, steps: Sequence[LogStep], path: Path, *, title: str, subtitle: str = ""
) -> None:
    """Draw every step that was found in a log. Raises ``PictureError``."""
    shown = list(steps)[:MAX_CELLS]
    if not shown:
        raise PictureError(f"{path}: no picture: no step to draw", "no_step")
    times_s = log.numbers("time_s")
    rows = math.ceil(len(shown) / COLUMNS)
    with sheet_for(path) as sheet:
        columns = max(3, min(COLUMNS, len(shown)))
        width = 2 * MARGIN_IN + columns * (CELL_WIDTH_IN + GAP_WIDTH_IN)
        sheet.resize(width, HEAD_IN + 0.3 + rows * (CELL_HEIGHT_IN + GAP_HEIGHT_IN))
        sheet.text(MARGIN_IN, 0.2, title, size=15, weight="bold")
        sheet.text(MARGIN_IN, 0.5, subtitle, size=9.5, color=MUTED)
        words = "blue: flown; dashed: the board's estimate; dotted: asked; times in s"
        sheet.text(MARGIN_IN, 0.7, words, size=8.5, color=MUTED)
        for number, step in enumerate(shown):
            axes = _cell(sheet, number, HEAD_IN + 0.3)
            _draw_log_step(axes, log, times_s, step)


def _cell(sheet: Sheet, number: int, top_in: float) -> Axes:
    row, column = divmod(number, COLUMNS)
    return sheet.axes(
        MARGIN_IN + column * (CELL_WIDTH_IN + GAP_WIDTH_IN),
        top_in + row * (CELL_HEIGHT_IN + GAP_HEIGHT_IN),
        CELL_WIDTH_IN,
        CELL_HEIGHT_IN,
    )


def _draw_comparison(axes: Axes, tuning: AxisTuning) -> None:
    plan = tuning.proposal.steps.plan
    _demand(axes, tuning.proposal.steps, len(plan.demands))
    for candidate, colour, words in (
        (tuning.now, ORANGE, "as it was"),
        (tuning.proposal, GREEN, "proposed"),
    ):
        times_s, values = _shown(candidate.steps, len(plan.demands))
        axes.plot(times_s, values, color=colour, lw=1.6, label=f"{words}: {candidate.gains}")
    axes.set_title("Steps", loc="left", size=10, weight="bold")
    axes.set_xlabel("time (s)")
    axes.set_ylabel(plan.unit)
    _room_for_legend(axes)


def _draw_loop(size_axes: Axes, phase_axes: Axes, tuning: AxisTuning) -> None:
    """Draw size and phase of the open loop with the proposed gains, and the margins."""
    curves: tuple[tuple[Loop, str, str, str], ...] = (
        (tuning.cruise, "cruise", BLUE, "-"),
        (tuning.dive, "dive", PURPLE, "--"),
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
        axes.axhline(level, color=INK, lw=0.8)
        axes.set_title(words, loc="left", size=10, weight="bold")
        axes.set_xlabel("frequency (Hz)")
        axes.set_ylabel(unit)
        axes.xaxis.set_major_formatter("{x:g}")
        _room_for_legend(axes)


def _draw_candidate(axes: Axes, candidate: Candidate, tuning: AxisTuning) -> None:
    steps = candidate.steps
    is_chosen = candidate is tuning.proposal
    colour = GREEN if is_chosen else MUTED if candidate.broken else BLUE
    _demand(axes, steps, SHOWN_STEPS)
    axes.plot(*_shown(steps, SHOWN_STEPS), color=colour, lw=2.0 if is_chosen else 1.3)
    axes.set_title(str(candidate.gains), loc="left", size=8, weight="bold", pad=12, color=colour)
    words = _figures(steps.rise_time_s, steps.overshoot_percent, steps.settling_time_s)
    axes.text(0, 1.03, words, transform=axes.transAxes, size=7.5, color=MUTED)
    axes.tick_params(labelsize=7)
    if is_chosen:
        for spine in axes.spines.values():
            spine.set_visible(True)
            spine.set_color(GREEN)
            spine.set_linewidth(1.8)


def _draw_log_step(axes: Axes, log: Log, times_s: Sequence[float], step: LogStep) -> None:
    suffix = "deg" if step.unit == "deg" else "rate_deg_s"
    name = f"{step.axis}_{suffix}"
    rows = [
        at for at, time_s in enumerate(times_s) if step.at_s - 0.5 <= time_s <= step.until_s + 0.2
    ]
    shown_s = [times_s[at] for at in rows]
    for source, colour, style, width in (
        ("demand", DEMAND, ":", 1.2),
        ("board", ORANGE, "--", 1.0),
        ("truth", BLUE, "-", 1.5),
    ):
        if f"{source}.{name}" in log:
            values = log.numbers(f"{source}.{name}")
            axes.plot(shown_s, [values[at] for at in rows], color=colour, ls=style, lw=width)
    response = step.response
    title = f"{step.axis} {step.mode} at {step.at_s:.1f} s: {step.start:.0f} to {step.end:.0f}"
    axes.set_title(title, loc="left", size=8, weight="bold", pad=12)
    words = step.problem[:48] if response is None else _step_figures(response)
    colour = FAULT if response is None or response.rise_time_s is None else MUTED
    axes.text(0, 1.03, words, transform=axes.transAxes, size=7.5, color=colour)
    axes.tick_params(labelsize=7)


def _step_figures(response: StepResponse) -> str:
    return _figures(response.rise_time_s, response.overshoot_percent, response.settling_time_s)


def _figures(rise_s: float | None, overshoot: float, settling_s: float | None) -> str:
    rise = "never rises" if rise_s is None else f"rise {rise_s:.2f}"
    settling = "not settled" if settling_s is None else f"settles {settling_s:.2f}"
    return f"{rise}, {settling}, over {overshoot:.0f} %"


def _demand(axes: Axes, steps: FlownSteps, count: int) -> None:
    plan = steps.plan
    times_s, values = [-0.5, 0.0], [0.0, 0.0]
    for number, demand in enumerate(plan.demands[:count]):
        times_s += [number * plan.hold_s, (number + 1) * plan.hold_s]
        values += [demand, demand]
    axes.plot(times_s, values, color=DEMAND, ls=":", lw=1.2)
    axes.axhline(0, color=GRID, lw=0.6)


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
