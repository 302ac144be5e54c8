"""The track in metres from home, measured and true, and the wind."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from up.earth import distance_m
from up_flightlog.export.track import TrackPoint, points_of, segments_of
from up_flightlog.plots.track_picture import Path, TrackView, Wind
from up_flightlog.read.series import Series
from up_flightlog.report.report_data import ReportData

_METRES_A_DEGREE = 111_194.9
_MAX_POINTS = 6000


def track_view(data: ReportData, marks: Sequence[float]) -> TrackView | None:
    """Return the content of the track's picture; None if the log contains no position."""
    log = data.log
    segments = list(segments_of(points_of(log)))
    latitude, longitude = data.truth["latitude_deg"], data.truth["longitude_deg"]
    true_points = [
        TrackPoint(log.start_unix_s + time_s, *place)
        for time_s, *place in zip(latitude.times_s, latitude.values, longitude.values, strict=False)
    ]
    truth_segments = list(segments_of(true_points))
    if not segments:
        segments, truth_segments = truth_segments, []
    if not segments:
        return None
    home = segments[0][0]
    truth = _path(truth_segments, home, log.start_unix_s) if truth_segments else None
    return TrackView(_path(segments, home, log.start_unix_s), truth, _wind(data), marks)


def offsets_m(
    latitude_deg: float, longitude_deg: float, home_latitude_deg: float, home_longitude_deg: float
) -> tuple[float, float]:
    """Return a position as metres east and north of home."""
    east_deg = (longitude_deg - home_longitude_deg + 180) % 360 - 180
    narrow = math.cos(math.radians(home_latitude_deg))
    north_deg = latitude_deg - home_latitude_deg
    return east_deg * _METRES_A_DEGREE * narrow, north_deg * _METRES_A_DEGREE


def place_error_m(data: ReportData) -> Series:
    """Return the distance (m) of each measured position from the true one at its time."""
    latitude, longitude = data.truth["latitude_deg"], data.truth["longitude_deg"]
    found = Series()
    if not latitude:
        return found
    for point in points_of(data.log):
        time_s = point.unix_s - data.log.start_unix_s
        true = latitude.at(time_s), longitude.at(time_s)
        if true[0] is not None and true[1] is not None:
            found.add(time_s, distance_m(point.latitude_deg, point.longitude_deg, true[0], true[1]))
    return found


def _path(segments: Iterable[Sequence[TrackPoint]], home: TrackPoint, start_unix_s: float) -> Path:
    """Return the segments as one path, broken (nan) between them; long ones are thinned."""
    segments = list(segments)
    every = max(1, sum(map(len, segments)) // _MAX_POINTS)
    times_s: list[float] = []
    east_m: list[float] = []
    north_m: list[float] = []
    for segment in segments:
        if times_s:
            times_s.append(times_s[-1])
            east_m.append(math.nan)
            north_m.append(math.nan)
        for point in [*segment[:-1:every], segment[-1]]:
            times_s.append(point.unix_s - start_unix_s)
            at = (point.latitude_deg, point.longitude_deg)
            point_m = offsets_m(*at, home.latitude_deg, home.longitude_deg)
            east_m.append(point_m[0])
            north_m.append(point_m[1])
    return Path(times_s, east_m, north_m)


def _wind(data: ReportData) -> Wind | None:
    """Return the mean wind if the log has it: only simulated flights do."""
    north, east = data.truth["wind_north_m_s"], data.truth["wind_east_m_s"]
    if not north or not east:
        return None
    mean_north = sum(north.values) / len(north.values)
    mean_east = sum(east.values) / len(east.values)
    from_deg = math.degrees(math.atan2(-mean_east, -mean_north)) % 360
    return Wind(math.hypot(mean_north, mean_east), from_deg)
