"""A track as GPX and KML: other programs read every flight as it was."""

import math
from datetime import UTC, datetime, timedelta
from xml.etree import ElementTree

import gpxpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from up_flightlog.export.gpx import gpx_lines
from up_flightlog.export.kml import kml_lines
from up_flightlog.export.track import Place, Track, TrackPoint, segments_of, utc_text

KML = "{http://www.opengis.net/kml/2.2}"
GX = "{http://www.google.com/kml/ext/2.2}"
SPEED = "{http://www.garmin.com/xmlschemas/TrackPointExtension/v2}speed"
COURSE = "{http://www.garmin.com/xmlschemas/TrackPointExtension/v2}course"
ANY = st.floats(allow_nan=True, allow_infinity=True)
POINTS = st.builds(
    TrackPoint,
    unix_s=st.floats(0, 4e9),
    latitude_deg=st.floats(-90, 90),
    longitude_deg=st.floats(-180, 180),
    altitude_m=st.none() | st.floats(-1000, 100000) | ANY,
    speed_m_s=st.none() | st.floats(0, 500) | ANY,
    bearing_deg=st.none() | st.floats(-360, 360) | st.just(math.nan),
)
NAMES = st.text(max_size=40) | st.sampled_from(
    ["</name><script>", "]]>&amp;", "a\x00b\x1b[2J", "\ud800", "<b>&", "\r\n", "☂ 飛行機"]
)
TRACKS = st.builds(
    Track,
    name=NAMES,
    description=NAMES,
    segments=st.lists(st.lists(POINTS, min_size=1, max_size=5), max_size=3),
    places=st.lists(st.builds(Place, POINTS, NAMES), max_size=2),
)


def as_xml_has_it(text):
    """A text as far as XML can hold it: forbidden characters replaced, line ends as line feeds."""
    allowed = (
        c
        if c in "\t\n\r" or ("\x20" <= c <= "\ud7ff" or "\ue000" <= c <= "\ufffd" or c > "\uffff")
        else "\ufffd"
        for c in text
    )
    return "".join(allowed).replace("\r", "\n")


def close(found, meant, within):
    if meant is None or not math.isfinite(meant):
        return found is None
    return abs(found - meant) <= within + 1e-12 * abs(meant)


@settings(deadline=None)
@given(TRACKS)
def test_gpxpy_reads_the_gpx(track):
    document = gpxpy.parse("".join(gpx_lines(track)).encode())
    assert document.version == "1.1"
    assert (document.name or "") == as_xml_has_it(track.name)
    (read,) = document.tracks
    assert (read.name or "") == as_xml_has_it(track.name)
    assert [len(each.points) for each in read.segments] == [len(each) for each in track.segments]
    for found, meant in zip(
        (point for segment in read.segments for point in segment.points),
        (point for segment in track.segments for point in segment),
        strict=True,
    ):
        assert close(found.latitude, meant.latitude_deg, 1e-7)
        assert -180 <= found.longitude < 180
        turn = abs(found.longitude - meant.longitude_deg) % 360
        assert min(turn, 360 - turn) <= 1e-7
        assert close(found.elevation, meant.altitude_m, 0.006)
        moment = datetime.fromtimestamp(0, UTC) + timedelta(seconds=meant.unix_s)
        assert abs(found.time - moment) <= timedelta(milliseconds=1.1)
        inner = {each.tag: float(each.text) for outer in found.extensions for each in outer}
        assert close(inner.get(SPEED), meant.speed_m_s, 0.0006)
        course = meant.bearing_deg
        if course is None or not math.isfinite(course):
            assert COURSE not in inner
        else:
            turn = abs(inner[COURSE] - course) % 360
            assert 0 <= inner[COURSE] < 360 and min(turn, 360 - turn) <= 0.0051
    assert [each.name or "" for each in document.waypoints] == [
        as_xml_has_it(place.name) for place in track.places
    ]


@settings(deadline=None)
@given(TRACKS)
def test_the_kml_has_the_line_and_the_times(track):
    root = ElementTree.fromstring("".join(kml_lines(track)).encode())
    (document,) = root
    assert document.findtext(f"{KML}name") == as_xml_has_it(track.name)
    lines = document.findall(f".//{KML}LineString")
    assert len(lines) == sum(len(segment) > 1 for segment in track.segments)
    timed = document.findall(f".//{GX}Track")
    assert len(timed) == len(track.segments)
    for found, meant in zip(timed, track.segments, strict=True):
        moments = [each.text for each in found.findall(f"{KML}when")]
        assert moments == [utc_text(point.unix_s) for point in meant]
        places = [list(map(float, each.text.split())) for each in found.findall(f"{GX}coord")]
        assert len(places) == len(meant)
        has_height = any(
            point.altitude_m is not None and math.isfinite(point.altitude_m) for point in meant
        )
        mode = found.findtext(f"{KML}altitudeMode")
        assert mode == ("absolute" if has_height else "clampToGround")
        for (_, latitude, height), point in zip(places, meant, strict=True):
            assert close(latitude, point.latitude_deg, 1e-7)
            if point.altitude_m is not None and math.isfinite(point.altitude_m):
                assert close(height, point.altitude_m, 0.006)
    shown = {f"{KML}{name}" for name in ("Placemark", "name", "description", "Style")}
    assert {each.tag for each in document} <= shown


def test_a_description_is_text_even_where_it_is_shown_as_html():
    track = Track("plane", "<script>alert(1)</script>", [])
    root = ElementTree.fromstring("".join(kml_lines(track)))
    assert root.findtext(f".//{KML}description") == "&lt;script&gt;alert(1)&lt;/script&gt;"


def test_a_place_without_an_altitude_lies_on_the_ground():
    home = Place(TrackPoint(0, 1, 2), "home")
    root = ElementTree.fromstring("".join(kml_lines(Track("a", "", [], [home]))))
    assert root.findtext(f".//{KML}Point/{KML}altitudeMode") == "clampToGround"


def test_a_missing_altitude_repeats_the_previous_one():
    heights = (None, 20.0, None, 30.0)
    points = [TrackPoint(at, 1, 2, height) for at, height in enumerate(heights)]
    root = ElementTree.fromstring("".join(kml_lines(Track("a", "", [points]))))
    coordinates = [each.text.split()[2] for each in root.iter(f"{GX}coord")]
    assert coordinates == ["20.00", "20.00", "20.00", "30.00"]


@pytest.mark.parametrize(
    ("times", "lengths"),
    [([0, 1, 2], [3]), ([0, 1, 11, 12], [2, 2]), ([0, 9.9, 19.8], [3]), ([], [])],
)
def test_a_silence_begins_a_new_segment(times, lengths):
    points = [TrackPoint(each, 1, 2) for each in times]
    assert [len(each) for each in segments_of(points)] == lengths


def test_impossible_positions_are_dropped():
    wrong = [(math.nan, 0), (0, math.inf), (91, 0), (0, 181), (-90.1, 0)]
    points = [TrackPoint(0, *place) for place in [(50, 14), *wrong, (50, 15)]]
    assert [[p.longitude_deg for p in each] for each in segments_of(points)] == [[14, 15]]


@pytest.mark.parametrize("unix_s", [math.inf, -math.inf, math.nan, 1e18, -1e18])
def test_a_time_that_no_calendar_has(unix_s):
    assert utc_text(unix_s) is None
    track = Track("a", "", [[TrackPoint(unix_s, 1, 2, 3)]])
    point = gpxpy.parse("".join(gpx_lines(track))).tracks[0].segments[0].points[0]
    assert point.time is None and point.elevation == 3
    root = ElementTree.fromstring("".join(kml_lines(track)))
    assert root.find(f".//{GX}Track") is None
