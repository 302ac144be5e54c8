"""The whole flight on one picture: panels over time, the track beside them."""

from __future__ import annotations

from collections.abc import Sequence

from black_box_cog.pictures.canvas import Sheet
from black_box_cog.pictures.chart import Panel, Stage
from black_box_cog.pictures.timeline import draw_timeline, timeline_height_in
from black_box_cog.pictures.track_picture import TrackView, draw_track

WIDTH_IN, HEAD_IN = 15.0, 0.62
_TRACK_IN, _BETWEEN_IN = 5.6, 0.3


def overview_height_in(panels: Sequence[Panel], stage: Stage) -> float:
    """Return the height of the picture."""
    below_in = timeline_height_in(panels, stage, _panels_in()) if panels else 0.0
    return HEAD_IN + max(below_in, _TRACK_IN)


def draw_overview(
    sheet: Sheet,
    title: str,
    subtitle: str,
    panels: Sequence[Panel],
    stage: Stage,
    track: TrackView | None,
) -> None:
    """Draw both; a missing one leaves its place empty."""
    sheet.text(0.62, 0.12, title, size=14, weight="bold")
    sheet.text(0.62, 0.38, subtitle, size=9, color=sheet.theme.muted)
    below_in = sheet.height - HEAD_IN
    if panels:
        draw_timeline(sheet.part(0.0, HEAD_IN, _panels_in(), below_in), panels, stage)
    if track is not None:
        left_in = sheet.width - _TRACK_IN
        draw_track(sheet.part(left_in, HEAD_IN, _TRACK_IN, _TRACK_IN), track)


def _panels_in() -> float:
    return WIDTH_IN - _TRACK_IN - _BETWEEN_IN
