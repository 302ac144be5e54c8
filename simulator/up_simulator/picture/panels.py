"""The panels over time: their signals, styles and axis labels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from up_simulator.picture.palette import (
    BLUE,
    CHANNELS,
    DEMAND,
    ESTIMATE,
    GREEN,
    ORANGE,
    PURPLE,
    SHADE,
    SHADE_EDGE,
    TRUTH,
    VERMILION,
)
from up_simulator.picture.series import Log, numbers, thinned

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True)
class Line:
    """A signal and its style."""

    signal: str
    label: str
    colour: str
    style: str = "-"
    width: float = 1.3
    is_right: bool = False


@dataclass(frozen=True, slots=True)
class Panel:
    """Signals over one time axis; ``needed`` leaves the panel out where that one is not known."""

    title: str
    unit: str
    lines: tuple[Line, ...]
    needed: str = ""
    right_unit: str = ""
    share: float = 1.0
    about: float | None = None
    """A level that gets a thin line."""
    least_range: float = 0.0

    def known(self, log: Log) -> list[tuple[Line, list[float]]]:
        if self.needed and numbers(log, self.needed) is None:
            return []
        found = ((line, numbers(log, line.signal)) for line in self.lines)
        return [(line, values) for line, values in found if values is not None]

    def shows(self, signal: str) -> bool:
        """Return whether a signal is drawn here, or is the error of one that is."""
        axis = signal.replace("estimate_error.", "truth.").replace("error.", "truth.")
        return any(line.signal in (signal, axis) for line in self.lines)


def _attitude(axis: str, title: str) -> Panel:
    return Panel(
        title,
        "deg",
        (
            Line(f"truth.{axis}_deg", "truth", TRUTH, width=1.6),
            Line(f"board.{axis}_deg", "estimate of the board", ESTIMATE, "--"),
            Line(f"demand.{axis}_deg", "demand", DEMAND, ":", 1.4),
        ),
        share=1.4,
        least_range=10.0,
    )


def _rate(axis: str, title: str) -> Panel:
    return Panel(
        title,
        "deg/s",
        (
            Line(f"truth.{axis}_rate_deg_s", "truth", TRUTH, width=1.6),
            Line(f"board.{axis}_rate_deg_s", "gyroscope", ESTIMATE, "--"),
            Line(f"demand.{axis}_rate_deg_s", "demand", DEMAND, ":", 1.4),
        ),
        needed=f"demand.{axis}_rate_deg_s",
        least_range=10.0,
    )


def _pulses(source: str, title: str) -> Panel:
    styles = {"ailerons": "-", "elevator": "--", "throttle": "-.", "rudder": ":"}
    return Panel(
        title,
        "us",
        tuple(
            Line(f"{source}.{channel}_us", channel, colour, styles[channel])
            for channel, colour in CHANNELS.items()
        ),
        about=1500.0,
        least_range=200.0,
    )


PANELS = (
    _attitude("roll", "Roll"),
    _attitude("pitch", "Pitch"),
    _rate("roll", "Roll rate"),
    _rate("pitch", "Pitch rate"),
    _pulses("stick", "Sticks"),
    _pulses("servo", "Servo pulses"),
    Panel(
        "Height and airspeed",
        "m",
        (
            Line("truth.height_m", "height above ground (m)", BLUE),
            Line("truth.airspeed_m_s", "airspeed (m/s, right)", VERMILION, "--", is_right=True),
        ),
        right_unit="m/s",
        least_range=5.0,
    ),
    Panel(
        "Load factor",
        "g",
        (Line("truth.load_factor_g", "load factor", PURPLE),),
        share=0.75,
        about=1.0,
        least_range=1.0,
    ),
    Panel(
        "Ages",
        "s",
        (
            Line("ground.age_s", "telemetry on the ground", GREEN),
            Line("board.status_age_s", "status of the board", ORANGE, "--"),
        ),
        needed="ground.age_s",
        share=0.75,
        least_range=1.0,
    ),
)


def draw_panel(
    axes: Axes,
    panel: Panel,
    known: Sequence[tuple[Line, list[float]]],
    times_s: Sequence[float],
) -> None:
    """Draw the lines of a panel with title and legend above it."""
    right = None
    if any(line.is_right for line, _ in known):
        right = axes.twinx()
        right.grid(False)
        right.set_ylabel(panel.right_unit)
        right.spines["right"].set_visible(True)
    handles: list[Any] = []
    for line, values in known:
        into = right if line.is_right and right is not None else axes
        drawn = into.plot(
            *thinned(times_s, values),
            color=line.colour,
            linestyle=line.style,
            linewidth=line.width,
            label=line.label,
            zorder=3,
        )
        handles += drawn
    if panel.about is not None:
        axes.axhline(panel.about, color=DEMAND, lw=0.5, zorder=1)
    _widen(axes, panel.least_range, [values for line, values in known if not line.is_right])
    if right is not None:
        _widen(right, 5.0, [values for line, values in known if line.is_right])
        for into, is_right in ((axes, False), (right, True)):
            colour = next((line.colour for line, _ in known if line.is_right == is_right), None)
            if colour:
                into.tick_params(axis="y", labelcolor=colour)
                into.yaxis.label.set_color(colour)
    axes.set_ylabel(panel.unit)
    axes.set_title(panel.title, loc="left", size=10, weight="bold", pad=5)
    axes.legend(
        handles=handles,
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncol=len(handles),
        borderaxespad=0.1,
        handlelength=2.4,
        columnspacing=1.4,
    )


def shade_failure(axes: Axes, begin_s: float, end_s: float, *, is_shown: bool) -> None:
    """Shade where an expectation was not held; only the foot where its signal is not shown."""
    axes.axvspan(
        begin_s,
        end_s,
        ymax=1.0 if is_shown else 0.07,
        facecolor=SHADE,
        edgecolor=SHADE_EDGE,
        hatch="////",
        lw=0,
        zorder=0.5,
    )


def _widen(axes: Axes, least: float, series: Sequence[Sequence[float]]) -> None:
    """Set limits with a margin, and wide enough that noise does not look like movement."""
    known = [value for values in series for value in values if math.isfinite(value)]
    if not known:
        return
    low, high = min(known), max(known)
    extra = max(0.0, least - (high - low)) / 2 + 0.06 * max(high - low, least)
    axes.set_ylim(low - extra, high + extra)
