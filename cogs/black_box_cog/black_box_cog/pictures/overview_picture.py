"""The whole flight on one picture: panels over time, the track beside them."""

from __future__ import annotations

from collections.abc import Sequence

from black_box_cog.pictures.canvas import Sheet
from black_box_cog.pictures.chart import Panel, Stage
from black_box_cog.pictures.timeline import draw_timeline
from black_box_cog.pictures.track_picture import TrackView, draw_track

OVERVIEW_IN = (15.0, 6.6)
_TRACK_IN = (5.6, 5.6)


def draw_overview(
    sheet: Sheet, panels: Sequence[Panel], stage: Stage, track: TrackView | None
) -> None:
    """Draw what there is of both: the one that is missing leaves its place to the other."""
    if track is None:
        draw_timeline(sheet, panels, stage)
    elif not panels:
        draw_track(sheet, track)
    else:
        width_in, height_in = _TRACK_IN
        draw_timeline(
            sheet.part(0.0, 0.1, sheet.width - width_in - 0.3, sheet.height), panels, stage
        )
        draw_track(sheet.part(sheet.width - width_in, 0.0, width_in, height_in), track)
