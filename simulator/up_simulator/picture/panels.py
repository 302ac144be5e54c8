"""The panels over time: their signals, styles and axis labels."""

from __future__ import annotations

from dataclasses import dataclass

from up_flightlog.plots.chart import Curve, Panel
from up_simulator.picture.series import numbers
from up_simulator.scenario.log import FlightLog

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
