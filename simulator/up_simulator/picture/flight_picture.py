"""The picture of a flight: demands, response, events and track."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass, replace

from up_flightlog.plots.canvas import PictureError
from up_flightlog.plots.chart import Background, Mark, Panel, Shade
from up_flightlog.plots.overview import Line, Overview
from up_flightlog.plots.track_picture import TrackView, Wind
from up_simulator.picture.panels import PANELS, SignalPanel
from up_simulator.picture.series import crash_index, mode_bands, numbers, track
from up_simulator.scenario.log import FlightLog

COLUMN = 66
"""Characters of a line below the track."""
FOOT = 0.07
"""The part of a panel that is shaded for a signal that no panel shows."""


@dataclass(frozen=True, slots=True)
class Failure:
    """A failed expectation: its signal, its window, a sentence."""

    signal: str
    begin_s: float
    end_s: float
    text: str


def overview_of(
    log: FlightLog,
    title: str = "",
    subtitle: str = "",
    marks: Sequence[Mark] | None = None,
    failures: Sequence[Failure] = (),
    wind: Wind | None = None,
) -> Overview:
    """Return the content of the picture; raises PictureError if there is nothing to draw.

    Without ``marks`` the events of the log are marked. Data missing in the log is left out.
    """
    times_s = log.numbers("time_s")
    if len(times_s) < 2:
        raise PictureError(f"no picture of a log with {len(times_s)} rows", "too_short")
    chosen = [(each, panel) for each in PANELS if (panel := each.of(log)) is not None]
    if not chosen:
        raise PictureError("no picture: the log has no signal to draw", "no_signal")
    if marks is None:
        marks = [Mark(at_s, text=name) for at_s, name in log.events]
    path = track(log)
    view = TrackView(path, wind=wind, is_crash=crash_index(log) is not None) if path else None
    background = Background(times_s[-1], mode_bands(log), marks)
    panels = _shaded(chosen, failures)
    return Overview(title or "Flight", subtitle, panels, background, view, _lines(log, failures))


def _shaded(
    chosen: Sequence[tuple[SignalPanel, Panel]], failures: Sequence[Failure]
) -> list[Panel]:
    """Return the panels, shaded where an expectation was not held.

    A signal that no panel shows shades the foot of all of them.
    """
    everywhere = [
        Shade(each.begin_s, each.end_s, FOOT)
        for each in failures
        if not any(signals.shows(each.signal) for signals, _ in chosen)
    ]
    return [
        replace(
            panel,
            shades=[
                *(
                    Shade(each.begin_s, each.end_s)
                    for each in failures
                    if signals.shows(each.signal)
                ),
                *everywhere,
            ],
        )
        for signals, panel in chosen
    ]


def _lines(log: FlightLog, failures: Sequence[Failure]) -> list[Line]:
    """Return the figures and sentences below the track."""
    lines: list[Line] = []
    times_s = log.numbers("time_s")
    lines.append(Line(f"{times_s[-1] - times_s[0]:.1f} s of flight"))
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
            lines.append(Line(words.format(low, high).replace("-0 ", "0 ")))
    for name, words in (("error.roll_deg", "roll error"), ("error.pitch_deg", "pitch error")):
        values = [value for value in numbers(log, name) or () if math.isfinite(value)]
        if values:
            rms = math.sqrt(sum(value * value for value in values) / len(values))
            lines.append(Line(f"{words} {rms:.2f} deg rms"))
    crash = crash_index(log)
    if crash is not None:
        lines.append(Line(f"crashed at {times_s[crash]:.2f} s", is_bad=True))
    if failures:
        lines += [Line(""), Line("Not held (shaded):", is_bad=True)]
    for failure in failures:
        for at, row in enumerate(textwrap.wrap(failure.text, COLUMN - 2)):
            lines.append(Line(("- " if at == 0 else "  ") + row, is_bad=True))
    return lines
