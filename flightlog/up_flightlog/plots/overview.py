"""One picture of a flight: panels over time on the left, the track and lines on the right."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from up_flightlog.plots.canvas import Sheet, png_of
from up_flightlog.plots.chart import Background, Panel
from up_flightlog.plots.mark_labels import SIZE_PT, place_labels
from up_flightlog.plots.theme import DAYLIGHT
from up_flightlog.plots.timeline import LEFT_IN, RIGHT_IN, draw_timeline, timeline_height_in
from up_flightlog.plots.track_picture import TrackView, draw_track

WIDTH_IN, HEAD_IN, DPI = 15.0, 0.62, 130
TRACK_IN, BETWEEN_IN, LINE_IN = 5.6, 0.3, 0.175
PANELS_IN = WIDTH_IN - TRACK_IN - BETWEEN_IN


@dataclass(frozen=True, slots=True)
class Line:
    """A line of text below the track."""

    text: str
    is_bad: bool = False


@dataclass(frozen=True, slots=True)
class Overview:
    """The content of the picture; a missing part leaves its place empty."""

    title: str
    subtitle: str
    panels: Sequence[Panel]
    background: Background
    track: TrackView | None
    lines: Sequence[Line] = ()


def overview_png(overview: Overview) -> bytes:
    """Return the picture as a PNG. Raises PictureError without matplotlib."""
    return png_of(partial(draw_overview, overview=overview), WIDTH_IN, HEAD_IN, DPI, DAYLIGHT)


def draw_overview(sheet: Sheet, overview: Overview) -> None:
    """Draw it onto a sheet, which gets the height that it needs."""
    panels, background = overview.panels, overview.background
    labels, left_out = place_labels(
        background.marks,
        background.length_s,
        PANELS_IN - LEFT_IN - RIGHT_IN,
        lambda text: sheet.text_width(text, SIZE_PT),
    )
    lines = [*overview.lines]
    if left_out:
        lines.append(Line(f"{left_out} more events have no room for a label"))
    panels_in = timeline_height_in(panels, background, PANELS_IN, labels) if panels else 0.0
    sheet.resize(WIDTH_IN, HEAD_IN + max(panels_in, TRACK_IN + LINE_IN * len(lines)))
    muted, bad = sheet.theme.muted, sheet.theme.vermilion
    sheet.text(LEFT_IN, 0.12, overview.title, size=14, weight="bold")
    sheet.text(LEFT_IN, 0.38, overview.subtitle, size=9, color=muted)
    if panels:
        part = sheet.part(0.0, HEAD_IN, PANELS_IN, panels_in)
        draw_timeline(part, panels, background, labels)
    left_in, top_in = WIDTH_IN - TRACK_IN, HEAD_IN + TRACK_IN
    if overview.track is not None:
        draw_track(sheet.part(left_in, HEAD_IN, TRACK_IN, TRACK_IN), overview.track)
    for number, line in enumerate(lines):
        place = (left_in + LEFT_IN, top_in + number * LINE_IN)
        sheet.text(*place, line.text, size=8.5, color=bad if line.is_bad else sheet.theme.ink)
