"""A track as GPX 1.1 (https://www.topografix.com/GPX/1/1/)."""

from __future__ import annotations

from collections.abc import Iterator

from up_flightlog.export.track import (
    Track,
    TrackPoint,
    degrees_text,
    is_known,
    longitude_text,
    utc_text,
    xml_text,
)

_GPX = "http://www.topografix.com/GPX/1/1"
_EXTENSION = "http://www.garmin.com/xmlschemas/TrackPointExtension/v2"
_HEAD = f"""\
<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="Raspilot" xmlns="{_GPX}" xmlns:gpxtpx="{_EXTENSION}"
 xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="{_GPX} {_GPX}/gpx.xsd
 {_EXTENSION} {_EXTENSION.replace("/v2", "v2")}.xsd">
"""


def gpx_lines(track: Track) -> Iterator[str]:
    """Yield the document in pieces.

    Speed (m/s) and course (degrees) are in Garmin's track point extension, version 2, because GPX
    1.1 has no elements for them.
    """
    yield _HEAD
    yield f"<metadata><name>{xml_text(track.name)}</name>"
    yield f"<desc>{xml_text(track.description)}</desc>"
    first = next((point for segment in track.segments for point in segment), None)
    if first is not None and (begun := utc_text(first.unix_s)):
        yield f"<time>{begun}</time>"
    yield "</metadata>\n"
    for place in track.places:
        yield f"<wpt {_position(place.point)}>{_height_and_time(place.point)}"
        yield f"<name>{xml_text(place.name)}</name></wpt>\n"
    yield f"<trk><name>{xml_text(track.name)}</name>\n"
    for segment in track.segments:
        yield "<trkseg>\n"
        for point in segment:
            yield f"<trkpt {_position(point)}>{_height_and_time(point)}{_motion(point)}</trkpt>\n"
        yield "</trkseg>\n"
    yield "</trk>\n</gpx>\n"


def _position(point: TrackPoint) -> str:
    latitude, longitude = degrees_text(point.latitude_deg), longitude_text(point.longitude_deg)
    return f'lat="{latitude}" lon="{longitude}"'


def _height_and_time(point: TrackPoint) -> str:
    height = f"<ele>{point.altitude_m:.2f}</ele>" if is_known(point.altitude_m) else ""
    moment = utc_text(point.unix_s)
    return f"{height}<time>{moment}</time>" if moment else height


def _motion(point: TrackPoint) -> str:
    speed, course = point.speed_m_s, point.bearing_deg
    inner = f"<gpxtpx:speed>{speed:.3f}</gpxtpx:speed>" if is_known(speed) else ""
    if is_known(course):
        # Rounded first: 359.996 is north.
        inner += f"<gpxtpx:course>{round(course, 2) % 360:.2f}</gpxtpx:course>"
    if not inner:
        return ""
    tag = "gpxtpx:TrackPointExtension"
    return f"<extensions><{tag}>{inner}</{tag}></extensions>"
