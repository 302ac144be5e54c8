"""The picture of a flight: demands, response, events and track."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from up_simulator.picture.canvas import PictureError, Sheet, sheet_for
from up_simulator.picture.palette import FAULT, MUTED
from up_simulator.picture.panels import PANELS, Line, Panel, draw_panel, shade_failure
from up_simulator.picture.series import Log, Span, crash_index, mode_spans, numbers
from up_simulator.picture.timeline_strip import (
    SIZE_PT,
    Mark,
    PlacedMark,
    draw_background,
    draw_strip,
    place_marks,
    strip_height_in,
)
from up_simulator.picture.track_panel import Wind, draw_track

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Failure", "Mark", "PictureError", "Wind", "draw_flight"]

WIDTH_IN = 15.0
LEFT_IN, PANEL_WIDTH_IN = 0.75, 8.6
RIGHT_IN, TRACK_IN = 10.35, 4.4
PANEL_IN, BETWEEN_IN = 1.25, 0.42
HEAD_IN, FOOT_IN = 0.75, 0.6
LINE_IN = 0.175
COLUMN = 66
"""Characters of a line beside the panels."""


@dataclass(frozen=True, slots=True)
class Failure:
    """A failed expectation: its signal, its window, a sentence."""

    signal: str
    begin_s: float
    end_s: float
    text: str


def draw_flight(
    log: Log,
    path: Path,
    *,
    title: str = "",
    subtitle: str = "",
    marks: Sequence[Mark] | None = None,
    failures: Sequence[Failure] = (),
    wind: Wind | None = None,
) -> None:
    """Draw a flight from its log into ``path`` (.png or .svg); the same log gives the same bytes.

    Without ``marks`` the events of the log are marked. Data missing in the log is left out.
    Raises ``PictureError``: no matplotlib, no place to write, or nothing to draw.
    """
    times_s = log.numbers("time_s")
    if len(times_s) < 2:
        raise PictureError(f"{path}: no picture of a log with {len(times_s)} rows", "too_short")
    chosen = [(panel, known) for panel in PANELS if (known := panel.known(log))]
    if not chosen:
        raise PictureError(f"{path}: no picture: the log has no signal to draw", "no_signal")
    if marks is None:
        marks = [Mark(at_s, name) for at_s, name in log.events]
    with sheet_for(path) as sheet:
        _draw(sheet, log, chosen, _Heading(title, subtitle), marks, failures, wind)


@dataclass(frozen=True, slots=True)
class _Heading:
    title: str
    subtitle: str


def _draw(
    sheet: Sheet,
    log: Log,
    chosen: Sequence[tuple[Panel, list[tuple[Line, list[float]]]]],
    heading: _Heading,
    marks: Sequence[Mark],
    failures: Sequence[Failure],
    wind: Wind | None,
) -> None:
    times_s = log.numbers("time_s")
    spans = mode_spans(log)

    def measure(words: str) -> float:
        return sheet.text_width(words, size=SIZE_PT)

    placed, left_out = place_marks(marks, times_s[0], times_s[-1], PANEL_WIDTH_IN, measure)
    strip_in = strip_height_in(placed, bool(spans))
    panels_in = sum(PANEL_IN * panel.share + BETWEEN_IN for panel, _ in chosen)
    lines = _lines(log, failures, left_out)
    beside_in = TRACK_IN + 0.9 + LINE_IN * len(lines)
    sheet.resize(WIDTH_IN, HEAD_IN + max(strip_in + panels_in, beside_in) + FOOT_IN)

    sheet.text(LEFT_IN, 0.2, heading.title or "Flight", size=15, weight="bold")
    if heading.subtitle:
        sheet.text(LEFT_IN, 0.5, heading.subtitle, size=9.5, color=MUTED)

    strip = sheet.axes(LEFT_IN, HEAD_IN, PANEL_WIDTH_IN, strip_in)
    strip.set_xlim(times_s[0], times_s[-1])
    draw_strip(strip, strip_in, spans, placed, measure, PANEL_WIDTH_IN)
    _draw_panels(sheet, HEAD_IN + strip_in, chosen, times_s, spans, placed, failures)

    track = sheet.axes(RIGHT_IN, HEAD_IN + 0.25, TRACK_IN, TRACK_IN)
    if not draw_track(track, log, wind):
        track.set_axis_off()
        track.text(0.5, 0.5, "the log has no positions", ha="center", color=MUTED)
    top_in = HEAD_IN + 0.25 + TRACK_IN + 0.65
    for words, is_bad in lines:
        sheet.text(RIGHT_IN - 0.45, top_in, words, size=8.5, color=FAULT if is_bad else "k")
        top_in += LINE_IN


def _draw_panels(
    sheet: Sheet,
    top_in: float,
    chosen: Sequence[tuple[Panel, list[tuple[Line, list[float]]]]],
    times_s: Sequence[float],
    spans: Sequence[Span],
    placed: Sequence[PlacedMark],
    failures: Sequence[Failure],
) -> None:
    homeless = [
        each for each in failures if not any(panel.shows(each.signal) for panel, _ in chosen)
    ]
    axes: Axes | None = None
    for panel, known in chosen:
        top_in += BETWEEN_IN
        height_in = PANEL_IN * panel.share
        axes = sheet.axes(LEFT_IN, top_in, PANEL_WIDTH_IN, height_in)
        axes.set_xlim(times_s[0], times_s[-1])
        draw_background(axes, spans, placed)
        draw_panel(axes, panel, known, times_s)
        for failure in failures:
            is_shown = panel.shows(failure.signal)
            if is_shown or failure in homeless:
                shade_failure(axes, failure.begin_s, failure.end_s, is_shown=is_shown)
        axes.tick_params(labelbottom=False)
        top_in += height_in
    if axes is not None:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel("time (s)")


def _lines(log: Log, failures: Sequence[Failure], left_out: int) -> list[tuple[str, bool]]:
    """Return the figures and sentences beside the panels, and which of them are bad news."""
    lines: list[tuple[str, bool]] = []
    times_s = log.numbers("time_s")
    lines.append((f"{times_s[-1] - times_s[0]:.1f} s of flight", False))
    for name, words in (
        ("truth.roll_deg", "bank {:.0f} to {:.0f} deg"),
        ("truth.pitch_deg", "pitch {:.0f} to {:.0f} deg"),
        ("truth.height_m", "height {:.0f} to {:.0f} m"),
        ("truth.airspeed_m_s", "airspeed {:.1f} to {:.1f} m/s"),
        ("truth.load_factor_g", "load factor {:.2f} to {:.2f} g"),
    ):
        values = [value for value in numbers(log, name) or () if math.isfinite(value)]
        if values:
            # Adding zero turns a rounded minus zero into zero.
            low, high = (round(each, 2) + 0.0 for each in (min(values), max(values)))
            lines.append((words.format(low, high).replace("-0 ", "0 "), False))
    for name, words in (("error.roll_deg", "roll error"), ("error.pitch_deg", "pitch error")):
        values = [value for value in numbers(log, name) or () if math.isfinite(value)]
        if values:
            rms = math.sqrt(sum(value * value for value in values) / len(values))
            lines.append((f"{words} {rms:.2f} deg rms", False))
    crash = crash_index(log)
    if crash is not None:
        lines.append((f"crashed at {times_s[crash]:.2f} s", True))
    if left_out:
        lines.append((f"{left_out} more events have no room for a label", False))
    if failures:
        lines += [("", False), ("Not held (shaded):", True)]
    for failure in failures:
        for at, row in enumerate(textwrap.wrap(failure.text, COLUMN - 2)):
            lines.append((("- " if at == 0 else "  ") + row, True))
    return lines
