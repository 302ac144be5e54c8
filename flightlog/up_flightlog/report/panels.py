"""Selects the panels that a report draws from a log."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from up_flightlog.findings.flight_context import CHANNELS
from up_flightlog.plots.chart import Curve, Panel
from up_flightlog.read.series import Series, error_of
from up_flightlog.report.report_data import ReportData

_COLOURS = dict(zip(CHANNELS, ("blue", "vermilion", "green", "purple"), strict=True))
_STYLES = dict(zip(CHANNELS, ("-", "--", "-.", ":"), strict=True))
_LIFETIME_S = 0.5
"""A set-point is drawn for this long after the last one."""


@dataclass(frozen=True, slots=True)
class Picture:
    """Panels of one picture: ``name`` is the file's, ``caption`` explains them."""

    name: str
    title: str
    caption: str
    panels: tuple[Panel, ...]


def pictures_of(data: ReportData) -> Iterator[Picture]:
    """Yield the pictures over time for which the log has data."""
    for picture in (
        _attitude(data),
        _heights(data),
        _channels(data),
        _links(data),
        _power(data),
        _loops(data),
        _errors(data),
    ):
        panels = tuple(panel for panel in picture.panels if panel.curves)
        if panels:
            yield Picture(picture.name, picture.title, picture.caption, panels)


def _attitude(data: ReportData) -> Picture:
    panels = []
    for axis, title in (("roll", "Roll"), ("pitch", "Pitch")):
        demand = data.demand.roll if axis == "roll" else data.demand.pitch
        curves = [
            *_curve("truth", data.truth[f"{axis}_deg"], "blue", width=2.6),
            *_curve("measured", data.attitude[axis], "orange"),
            *_curve("set-point", demand, "ink", "--", width=1.0, gap_s=_LIFETIME_S),
        ]
        panels.append(Panel(title, "deg", curves, about=0.0, min_range=10.0, share=1.15))
    caption = (
        "Attitude and its set-point: from the sticks in FBW, from the Raspberry Pi while it flies,"
        " from the profile in failsafe. ACRO and RATE have no attitude set-point."
    )
    return Picture("attitude", "Attitude and set-point", caption, tuple(panels))


def _heights(data: ReportData) -> Picture:
    heights = [
        *_curve("truth", data.truth["altitude_m"], "blue", width=2.6),
        *_curve("measured", data.altitude, "orange"),
        *_curve("set-point", data.required_altitude, "ink", "--", is_step=True, gap_s=1e9),
    ]
    speeds = [
        *_curve("true airspeed", data.truth["airspeed_m_s"], "sky", ":"),
        *_curve("true ground speed", data.truth["ground_speed_m_s"], "blue", width=2.6),
        *_curve("ground speed", data.speed, "orange"),
    ]
    return Picture(
        "altitude",
        "Altitude and speed",
        "Altitude above sea level; ground speed as the position source reports it.",
        (
            Panel("Altitude", "m", heights, min_range=10.0),
            Panel("Speed", "m/s", speeds, min_range=4.0),
        ),
    )


def _channels(data: ReportData) -> Picture:
    panels = [
        Panel(
            title,
            "us",
            [
                curve
                for name in CHANNELS
                for curve in _curve(name, pulses[name], _COLOURS[name], _STYLES[name])
            ],
            about=1500.0,
            min_range=200.0,
        )
        for title, pulses in (("Sticks", data.sticks), ("Servo pulses", data.servos))
    ]
    switches = [
        *_curve("mode switch (AUX1)", data.sticks["aux1"], "blue"),
        *_curve("arming (AUX2)", data.sticks["aux2"], "vermilion", "--"),
    ]
    panels.append(Panel("Switches", "us", switches, about=1500.0, min_range=200.0, share=0.6))
    caption = "Pulses from the pilot's receiver and to the servos."
    return Picture("sticks", "Sticks and servos", caption, tuple(panels))


def _links(data: ReportData) -> Picture:
    colours = {"board": ("blue", "-"), "ground": ("green", "-.")}
    curves = [
        curve
        for name, series in data.silences.items()
        for curve in _curve(
            name, series, *colours.get(name, ("orange", "--")), is_step=True, gap_s=1e9
        )
    ]
    caption = (
        "The longest silence in each second. The ground's line shows how long no ground station"
        " was connected."
    )
    return Picture(
        "links", "Ages of the links", caption, (Panel("Silence", "s", curves, min_range=0.5),)
    )


def _power(data: ReportData) -> Picture:
    known = data.frames
    battery = _curve("phone's battery", known["android.batteryLevel"], "green", gap_s=1e9)
    voltage = _curve("flight battery", known["arduino.flight_battery_v"], "vermilion")
    load = [
        *_curve("processor", known["load.cpu"], "blue"),
        *_curve("memory", known["load.ram"], "purple", "--"),
    ]
    return Picture(
        "load",
        "Battery and load",
        "The batteries of phone and aircraft; the load of the Raspberry Pi.",
        (
            Panel("Phone's battery", "percent", battery, min_range=10.0, share=0.7),
            Panel("Flight battery", "V", voltage, min_range=1.0, share=0.7),
            Panel("Load of the Raspberry Pi", "percent", load, min_range=20.0),
        ),
    )


def _loops(data: ReportData) -> Picture:
    known, status = data.frames, data.status
    period = _curve("mean period", status["loop_us"] or known["arduino.loop_us"], "blue")
    late = _curve("greatest lateness", status["late_us"] or known["arduino.late_us"], "vermilion")
    blocked = _curve("blocks", data.blocked, "vermilion", is_step=True, gap_s=1e9)
    return Picture(
        "loops",
        "Loop times",
        "The control loop of the Arduino in each second: its mean period and its greatest lateness."
        " The Raspberry Pi: how often its event loop was blocked for more than 20 ms.",
        (
            Panel("Period of the control loop", "us", period, min_range=40.0, share=0.6),
            Panel("Lateness of the control loop", "us", late, min_range=50.0, share=0.8),
            Panel("Blocked event loop of the Raspberry Pi", "times", blocked, None, 2.0, 0.6),
        ),
    )


def _errors(data: ReportData) -> Picture:
    panels = []
    for axis, title in (("roll", "Error in roll"), ("pitch", "Error in pitch")):
        error, _ = error_of(data.attitude[axis], data.truth[f"{axis}_deg"], is_angle=True)
        curves = _curve("measured minus true", error, "vermilion")
        panels.append(Panel(title, "deg", curves, about=0.0, min_range=4.0, share=0.8))
    return Picture(
        "truth",
        "Measured against the truth",
        "This flight was simulated: measured values minus true ones.",
        tuple(panels),
    )


def _curve(
    label: str,
    series: Series,
    colour: str,
    style: str = "-",
    *,
    width: float = 1.3,
    is_step: bool = False,
    gap_s: float | None = None,
) -> list[Curve]:
    """Return the curve in a list, empty without values."""
    if not series:
        return []
    curve = Curve(
        label, series.times_s, series.values, colour, style, width, is_step=is_step, gap_s=gap_s
    )
    return [curve]
