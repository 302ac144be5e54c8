"""The pictures of a report: for wide and narrow screens, for light and dark pages."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial

from up.system.death_signal import request_death_signal
from up_flightlog.plots.canvas import Sheet, load_matplotlib, png_of
from up_flightlog.plots.chart import ready
from up_flightlog.plots.theme import DARK, DAYLIGHT
from up_flightlog.plots.timeline import draw_timeline, timeline_height_in
from up_flightlog.plots.track_picture import draw_track
from up_flightlog.report.content import ReportContent

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
    """Yield the track, then every picture over time; raises PictureError.

    Every processor draws: the work is the same for each, and none needs the others' result.
    """
    load_matplotlib()
    count = len(content.pictures) + (content.track is not None)
    workers = min(len(os.sched_getaffinity(0)), count)
    if workers < 2:
        yield from (_drawn(content, number) for number in range(count))
        return
    # A fork has the content already; only numbers and pictures pass between the processes.
    fork = multiprocessing.get_context("fork")
    with ProcessPoolExecutor(workers, fork, _begin, (content, os.getpid())) as pool:
        yield from pool.map(_drawn_in_worker, range(count))


_worker: list[ReportContent] = []


def _begin(content: ReportContent, parent: int) -> None:
    end_with_parent = request_death_signal(signal.SIGKILL, parent)
    if end_with_parent is not None:
        end_with_parent()
    _worker.append(content)


def _drawn_in_worker(number: int) -> ImageSet:
    return _drawn(_worker[0], number)


def _drawn(content: ReportContent, number: int) -> ImageSet:
    """Draw the picture with a number: the track, if there is one, is the first."""
    track = content.track
    if track is not None:
        if number == 0:
            paint = partial(draw_track, view=track)
            return _set("track", paint, TRACK_WIDE_IN, TRACK_NARROW_IN)
        number -= 1
    picture = content.pictures[number]
    panels, background = ready(picture.panels), content.background
    sizes = [(each, timeline_height_in(panels, background, each)) for each in (WIDE_IN, NARROW_IN)]
    return _set(picture.name, partial(draw_timeline, panels=panels, background=background), *sizes)


def _set(
    name: str,
    paint: Callable[[Sheet], None],
    wide_in: tuple[float, float],
    narrow_in: tuple[float, float],
) -> ImageSet:
    return ImageSet(
        name,
        png_of(paint, *wide_in, WIDE_DPI, DAYLIGHT),
        png_of(paint, *wide_in, WIDE_DPI, DARK),
        png_of(paint, *narrow_in, NARROW_DPI, DAYLIGHT),
        png_of(paint, *narrow_in, NARROW_DPI, DARK),
        wide_in[1] / wide_in[0],
    )
