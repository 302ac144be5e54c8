"""Panels one below the other over the same time, with the flight modes behind them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from up_flightlog.plots.canvas import Sheet
from up_flightlog.plots.chart import Background, Curve, Panel, drawable, is_drawable
from up_flightlog.plots.mark_labels import ROW_IN, SIZE_PT, PlacedLabel

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STRIP_IN, PANEL_IN, FOOT_IN = 0.22, 1.45, 0.42
HEAD_IN, NARROW_HEAD_IN, NARROW_IN = 0.4, 0.58, 6.0
"""Space above a panel for its title and its legend, stacked where it is narrow."""
LEFT_IN, RIGHT_IN = 0.62, 0.22
_STEPS_S = (0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200)
_LABEL_IN = 0.8


def timeline_height_in(
    panels: Sequence[Panel],
    background: Background,
    width_in: float,
    labels: Sequence[PlacedLabel] = (),
) -> float:
    """Return the height of the picture of these panels, with the labels above them."""
    head_in = _head_in(width_in)
    panels_in = sum(head_in + PANEL_IN * panel.share for panel in panels)
    return _strip_in(background, labels) + panels_in + FOOT_IN


def draw_timeline(
    sheet: Sheet,
    panels: Sequence[Panel],
    background: Background,
    labels: Sequence[PlacedLabel] = (),
) -> None:
    """Draw the panels onto a sheet of `timeline_height_in`."""
    width_in = sheet.width - LEFT_IN - RIGHT_IN
    top_in = _strip_in(background, labels)
    if top_in:
        _draw_strip(sheet, background, labels, width_in)
    for number, panel in enumerate(panels, 1):
        top_in += _head_in(sheet.width)
        height_in = PANEL_IN * panel.share
        axes = sheet.axes(LEFT_IN, top_in, width_in, height_in)
        axes.set_xlim(0.0, _end_s(background))
        _draw_background(axes, background, sheet)
        _draw_panel(axes, panel, sheet)
        _set_times(axes, background, width_in, is_last=number == len(panels))
        top_in += height_in


def time_text(seconds: float) -> str:
    """Return a time on the axis: 1:30, or 12.5 for a short span."""
    if seconds % 1:
        return f"{seconds:g}"
    whole = round(seconds)
    if whole >= 3600:
        return f"{whole // 3600}:{whole // 60 % 60:02d}:{whole % 60:02d}"
    return f"{whole // 60}:{whole % 60:02d}"


def limits(panel: Panel) -> tuple[float, float] | None:
    """Return the limits of the axis: all values and a margin, at least the minimum range."""
    known = [value for curve in panel.curves for value in curve.values if is_drawable(value)]
    if not known:
        return None
    low, high = min(known), max(known)
    min_range = panel.min_range or abs(high) * 0.02 or 1.0
    extra = max(0.0, min_range - (high - low)) / 2 + 0.06 * max(high - low, min_range)
    # Limits that floating point cannot distinguish are not an axis.
    extra = max(extra, 1e-9 * max(abs(low), abs(high)))
    # Quantities that cannot be negative get no negative axis.
    return (min(low, 0.0) if low >= 0 > low - extra else low - extra), high + extra


def _head_in(width_in: float) -> float:
    return NARROW_HEAD_IN if width_in < NARROW_IN else HEAD_IN


def _end_s(background: Background) -> float:
    return max(background.length_s, 0.1)


def _strip_in(background: Background, labels: Sequence[PlacedLabel]) -> float:
    """Return the height of the strip: the bands, and the rows of labels above them."""
    rows = 1 + max((label.row for label in labels), default=-1)
    return rows * ROW_IN + (STRIP_IN if background.bands else 0.0)


def _draw_strip(
    sheet: Sheet, background: Background, labels: Sequence[PlacedLabel], width_in: float
) -> None:
    height_in = _strip_in(background, labels)
    axes = sheet.axes(LEFT_IN, 0.0, width_in, height_in)
    axes.set_xlim(0.0, _end_s(background))
    axes.set_ylim(0.0, height_in)
    axes.set_axis_off()
    style: dict[str, Any] = {"va": "center_baseline", "size": SIZE_PT}
    for band in background.bands:
        colour = sheet.theme.band(band.name)
        axes.axvspan(band.begin_s, band.end_s, 0.0, STRIP_IN / height_in, color=colour, lw=0)
        room_in = (band.end_s - band.begin_s) / _end_s(background) * width_in
        if sheet.text_width(band.name, SIZE_PT) + 0.06 <= room_in:
            middle_s = (band.begin_s + band.end_s) / 2
            place = (middle_s, STRIP_IN / 2)
            axes.text(*place, band.name, color=sheet.theme.muted, ha="center", **style)
    foot_in = STRIP_IN if background.bands else 0.0
    for label in labels:
        low_in = foot_in + label.row * ROW_IN
        line = sheet.theme.vermilion if label.mark.is_bad else sheet.theme.muted
        axes.plot([label.mark.at_s] * 2, [0.0, low_in + ROW_IN - 0.02], color=line, lw=0.8)
        axes.annotate(
            label.text,
            (label.mark.at_s, low_in + ROW_IN / 2),
            xytext=(-4 if label.is_left else 4, 0),
            textcoords="offset points",
            ha="right" if label.is_left else "left",
            color=sheet.theme.vermilion if label.mark.is_bad else sheet.theme.ink,
            bbox={"facecolor": sheet.theme.paper, "edgecolor": "none", "pad": 0.8},
            **style,
        )


def _draw_background(axes: Axes, background: Background, sheet: Sheet) -> None:
    for band in background.bands:
        axes.axvspan(band.begin_s, band.end_s, color=sheet.theme.band(band.name), lw=0, zorder=0)
    for mark in background.marks:
        colour = sheet.theme.vermilion if mark.is_bad else sheet.theme.muted
        axes.axvline(mark.at_s, color=colour, lw=0.7, alpha=0.8, zorder=1.5)


def _draw_panel(axes: Axes, panel: Panel, sheet: Sheet) -> None:
    handles = [line for curve in panel.curves for line in _draw_curve(axes, curve, sheet)]
    for shade in panel.shades:
        axes.axvspan(
            shade.begin_s,
            shade.end_s,
            ymax=shade.height,
            facecolor=sheet.theme.band("failsafe"),
            edgecolor=sheet.theme.vermilion,
            hatch="////",
            lw=0,
            zorder=0.5,
        )
    if panel.about is not None:
        axes.axhline(panel.about, color=sheet.theme.muted, lw=0.6, zorder=1)
    ends = limits(panel)
    if ends is not None:
        axes.set_ylim(*ends)
        axes.locator_params(axis="y", nbins=5)
    axes.set_ylabel(panel.unit)
    is_narrow = sheet.width < NARROW_IN
    axes.set_title(panel.title, loc="left", size=9.5, weight="bold", pad=19 if is_narrow else 6)
    axes.legend(
        handles=handles,
        loc="lower left" if is_narrow else "lower right",
        bbox_to_anchor=(0.0 if is_narrow else 1.0, 1.0),
        ncol=len(handles),
        borderaxespad=0.1,
        borderpad=0.1 if is_narrow else 0.4,
        fontsize=7.5 if is_narrow else 8.5,
        handlelength=1.4 if is_narrow else 1.8,
        handletextpad=0.4,
        columnspacing=0.9 if is_narrow else 1.2,
    )


def _draw_curve(axes: Axes, curve: Curve, sheet: Sheet) -> list[Any]:
    is_rare = len(curve.values) < 3
    return axes.plot(
        *drawable(curve),
        color=getattr(sheet.theme, curve.colour),
        linestyle=curve.style,
        linewidth=curve.width,
        label=curve.label,
        drawstyle="steps-post" if curve.is_step else "default",
        # A line needs two points to be visible.
        marker="o" if is_rare else "",
        markersize=3.5,
        zorder=3,
    )


def _set_times(axes: Axes, background: Background, width_in: float, *, is_last: bool) -> None:
    end_s = _end_s(background)
    limit = max(2, int(width_in / _LABEL_IN))
    step_s = next((step for step in _STEPS_S if end_s / step <= limit), end_s)
    ticks = [step_s * number for number in range(int(end_s / step_s) + 1)]
    axes.set_xticks(ticks, [time_text(round(tick, 3)) for tick in ticks])
    axes.tick_params(labelbottom=is_last, length=3)
    if is_last:
        axes.set_xlabel("time of the flight (min:s)" if end_s >= 2 else "time of the flight (s)")
