"""A track as KML 2.2 with Google's gx:Track (OGC 07-147r2, KML Reference)."""

from __future__ import annotations

import html
from collections.abc import Iterator, Sequence

from up_flightlog.export.track import (
    Track,
    TrackPoint,
    degrees_text,
    is_known,
    longitude_text,
    utc_text,
    xml_text,
)

_HEAD = """\
<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2">
<Document>
"""
_STYLE = """\
<Style id="track"><LineStyle><color>ff009fe6</color><width>3</width></LineStyle>\
<PolyStyle><color>40009fe6</color></PolyStyle></Style>
"""


def kml_lines(track: Track) -> Iterator[str]:
    """Yield the document in pieces.

    The line is drawn at the measured altitudes above sea level; a flight without altitudes lies on
    the ground. The second placemark is the same track with its times, for the time slider.
    """
    yield _HEAD
    yield f"<name>{xml_text(track.name)}</name>"
    # A description is shown as HTML, even by programs that take a name for plain text.
    yield f"<description>{xml_text(html.escape(track.description))}</description>\n"
    yield _STYLE
    for place in track.places:
        mode, (height_m,) = _heights([place.point])
        yield f"<Placemark><name>{xml_text(place.name)}</name><Point>{mode}"
        yield f"<coordinates>{_coordinates(place.point, height_m)}</coordinates>"
        yield "</Point></Placemark>\n"
    yield from _line(track)
    yield from _with_times(track)
    yield "</Document>\n</kml>\n"


def _line(track: Track) -> Iterator[str]:
    yield "<Placemark><name>Track</name><styleUrl>#track</styleUrl><MultiGeometry>\n"
    for segment in track.segments:
        # A line needs two points.
        if len(segment) > 1:
            mode, heights_m = _heights(segment)
            yield f"<LineString><extrude>1</extrude><tessellate>1</tessellate>{mode}<coordinates>\n"
            for point, height_m in zip(segment, heights_m, strict=True):
                yield f"{_coordinates(point, height_m)}\n"
            yield "</coordinates></LineString>\n"
    yield "</MultiGeometry></Placemark>\n"


def _with_times(track: Track) -> Iterator[str]:
    timed = [
        [(point, moment) for point in segment if (moment := utc_text(point.unix_s))]
        for segment in track.segments
    ]
    timed = [segment for segment in timed if segment]
    if not timed:
        return
    yield "<Placemark><name>Track with times</name><styleUrl>#track</styleUrl><gx:MultiTrack>\n"
    for segment in timed:
        mode, heights_m = _heights([point for point, _ in segment])
        yield f"<gx:Track>{mode}\n"
        for _, moment in segment:
            yield f"<when>{moment}</when>\n"
        for (point, _), height_m in zip(segment, heights_m, strict=True):
            yield f"<gx:coord>{_coordinates(point, height_m).replace(',', ' ')}</gx:coord>\n"
        yield "</gx:Track>\n"
    yield "</gx:MultiTrack></Placemark>\n"


def _heights(points: Sequence[TrackPoint]) -> tuple[str, list[float]]:
    """Return the altitude mode and a height for each; an unknown one repeats the previous one."""
    known = [point.altitude_m for point in points if is_known(point.altitude_m)]
    height_m = known[0] if known else None
    if height_m is None:
        return "<altitudeMode>clampToGround</altitudeMode>", [0.0] * len(points)
    heights_m = []
    for point in points:
        if is_known(point.altitude_m):
            height_m = point.altitude_m
        heights_m.append(height_m)
    return "<altitudeMode>absolute</altitudeMode>", heights_m


def _coordinates(point: TrackPoint, height_m: float) -> str:
    longitude, latitude = longitude_text(point.longitude_deg), degrees_text(point.latitude_deg)
    return f"{longitude},{latitude},{height_m:.2f}"
