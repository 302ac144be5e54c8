"""The pictures of a report: for wide and narrow screens, for light and dark pages."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

from black_box_cog.pictures.canvas import Sheet, png_of
from black_box_cog.pictures.theme import DARK, DAYLIGHT, Theme
from black_box_cog.pictures.timeline import draw_timeline, timeline_height_in
from black_box_cog.pictures.track_picture import draw_track
from black_box_cog.report.content import ReportContent

WIDE_IN, NARROW_IN = 10.6, 4.2
WIDE_DPI, NARROW_DPI = 150, 200
TRACK_WIDE_IN, TRACK_NARROW_IN = (6.4, 6.0), (4.2, 4.6)


@dataclass(frozen=True, slots=True)
class ImageSet:
    """One picture in four versions, as PNGs; ``wide`` is also the one for print."""

    name: str
    wide: bytes
    wide_dark: bytes
    narrow: bytes
    narrow_dark: bytes
    ratio: float
    """Ratio of height to width of the wide version."""


def image_sets(content: ReportContent) -> Iterator[ImageSet]:
    """Draw the track, then every picture over time; raises PictureError."""
    track = content.track
    if track is not None:
        yield _drawn(
            "track", lambda sheet: draw_track(sheet, track), TRACK_WIDE_IN, TRACK_NARROW_IN
        )
    for picture in content.pictures:
        panels, stage = picture.panels, content.stage
        sizes = [(each, timeline_height_in(panels, stage, each)) for each in (WIDE_IN, NARROW_IN)]
        yield _drawn(picture.name, partial(draw_timeline, panels=panels, stage=stage), *sizes)


def _drawn(
    name: str,
    paint: Callable[[Sheet], None],
    wide_in: tuple[float, float],
    narrow_in: tuple[float, float],
) -> ImageSet:
    def drawn(size_in: tuple[float, float], dpi: int, theme: Theme) -> bytes:
        return png_of(paint, *size_in, dpi, theme)

    return ImageSet(
        name,
        drawn(wide_in, WIDE_DPI, DAYLIGHT),
        drawn(wide_in, WIDE_DPI, DARK),
        drawn(narrow_in, NARROW_DPI, DAYLIGHT),
        drawn(narrow_in, NARROW_DPI, DARK),
        wide_in[1] / wide_in[0],
    )
