"""The panels over time: the columns of a log that they draw, styles and axis labels."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from up_flightlog.plots.chart import Band, Curve, Panel
from up_flightlog.plots.track_picture import Path
from up_simulator.scenario.log import FlightLog


def numbers(log: FlightLog, name: str) -> list[float] | None:
    """Return a column, or ``None`` if it is missing or entirely unknown."""
    if name not in log:
        return None
    values = log.numbers(name)
    return values if any(math.isfinite(value) for value in values) else None


def mode_bands(log: FlightLog) -> list[Band]:
    """Return the modes with their times; a lost receiver's circle is the mode failsafe."""
    if "board.mode" not in log:
        return []
    modes = [str(mode) for mode in log.column("board.mode")]
    if "board.failsafe" in log:
        flags = log.numbers("board.failsafe")
        modes = ["failsafe" if flag == 1 else mode for mode, flag in zip(modes, flags, strict=True)]
    return list(_runs(log.numbers("time_s"), modes))


def track(log: FlightLog) -> Path | None:
    """Return metres east and north of the start; ``None`` if the log lacks them."""
    north, east = numbers(log, "truth.north_m"), numbers(log, "truth.east_m")
    return None if north is None or east is None else Path(log.numbers("time_s"), east, north)


def crash_index(log: FlightLog) -> int | None:
    """Return the row at which it crashed."""
    flags = numbers(log, "truth.crashed")
    return None if flags is None or 1.0 not in flags else flags.index(1.0)


def _runs(times_s: Sequence[float], names: Sequence[str]) -> Iterator[Band]:
    begin = 0
    for at in range(1, len(names) + 1):
        if at == len(names) or names[at] != names[begin]:
            if names[begin]:
                yield Band(times_s[begin], times_s[min(at, len(names) - 1)], names[begin])
            begin = at


_COLOURS = {"ailerons": "blue", "elevator": "vermilion", "throttle": "green", "rudder": "purple"}
_STYLES = {"ailerons": "-", "elevator": "--", "throttle": "-.", "rudder": ":"}


@dataclass(frozen=True, slots=True)
class Line:
    """A signal and its style; the colour is one of the theme."""

    signal: str
    label: str
    colour: str
    style: str = "-"
    width: float = 1.3


@dataclass(frozen=True, slots=True)
class SignalPanel:
    """Signals over one time axis; ``needed`` leaves the panel out if that signal is unknown."""

    title: str
    unit: str
    lines: tuple[Line, ...]
    needed: str = ""
    share: float = 1.0
    about: float | None = None
    """A level that gets a thin line."""
    min_range: float = 0.0

    def of(self, log: FlightLog) -> Panel | None:
        """Return the panel of a log, None without a known signal."""
        if self.needed and numbers(log, self.needed) is None:
            return None
        times_s = log.numbers("time_s")
        curves = [
            Curve(line.label, times_s, values, line.colour, line.style, line.width)
            for line in self.lines
            if (values := numbers(log, line.signal)) is not None
        ]
        if not curves:
            return None
        return Panel(self.title, self.unit, curves, self.about, self.min_range, self.share)

    def shows(self, signal: str) -> bool:
        """Return whether a signal is drawn here, or is the error of one that is."""
        axis = signal.replace("estimate_error.", "truth.").replace("error.", "truth.")
        return any(line.signal in (signal, axis) for line in self.lines)


def _attitude(axis: str, title: str) -> SignalPanel:
    return SignalPanel(
        title,
        "deg",
        (
            Line(f"truth.{axis}_deg", "truth", "blue", width=1.6),
            Line(f"board.{axis}_deg", "estimate of the board", "orange", "--"),
            Line(f"demand.{axis}_deg", "demand", "ink", ":", 1.4),
        ),
        share=1.4,
        min_range=10.0,
    )


def _rate(axis: str, title: str) -> SignalPanel:
    return SignalPanel(
        title,
        "deg/s",
        (
            Line(f"truth.{axis}_rate_deg_s", "truth", "blue", width=1.6),
            Line(f"board.{axis}_rate_deg_s", "gyroscope", "orange", "--"),
            Line(f"demand.{axis}_rate_deg_s", "demand", "ink", ":", 1.4),
        ),
        needed=f"demand.{axis}_rate_deg_s",
        min_range=10.0,
    )


def _pulses(source: str, title: str) -> SignalPanel:
    return SignalPanel(
        title,
        "us",
        tuple(
            Line(f"{source}.{channel}_us", channel, colour, _STYLES[channel])
            for channel, colour in _COLOURS.items()
        ),
        about=1500.0,
        min_range=200.0,
    )


PANELS = (
    _attitude("roll", "Roll"),
    _attitude("pitch", "Pitch"),
    _rate("roll", "Roll rate"),
    _rate("pitch", "Pitch rate"),
    _pulses("stick", "Sticks"),
    _pulses("servo", "Servo pulses"),
    SignalPanel(
        "Height above ground", "m", (Line("truth.height_m", "height", "blue"),), min_range=5.0
    ),
    SignalPanel("Airspeed", "m/s", (Line("truth.airspeed_m_s", "airspeed", "sky"),), min_range=5.0),
    SignalPanel(
        "Load factor",
        "g",
        (Line("truth.load_factor_g", "load factor", "purple"),),
        share=0.75,
        about=1.0,
        min_range=1.0,
    ),
    SignalPanel(
        "Ages",
        "s",
        (
            Line("ground.age_s", "telemetry on the ground", "green"),
            Line("board.status_age_s", "status of the board", "orange", "--"),
        ),
        needed="ground.age_s",
        share=0.75,
        min_range=1.0,
    ),
)
