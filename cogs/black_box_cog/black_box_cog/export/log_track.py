"""The track in a flight's log."""

from __future__ import annotations

from collections.abc import Iterator

from black_box_cog.export.track import Place, Track, TrackPoint, segments_of
from up.flight_log.flight_log import FlightLog
from up.flight_log.frame_state import place_of
from up.flight_log.json_message import number_at
from up.flight_log.track_statistics import fixes

LOCATION, TELEMETRY, MARK = "up.location.update", "up.telemetry.update", "black_box.mark"


def points_of(log: FlightLog) -> Iterator[TrackPoint]:
    """Yield the positions of the followed source in the order of time.

    Without a logged source these are telemetry's; a repeated position counts once.
    """
    start = log.start_unix_s
    if LOCATION in log.topics:
        for fix in fixes(log):
            place = (fix.latitude_deg, fix.longitude_deg, fix.altitude_m, fix.speed_m_s)
            yield TrackPoint(start + fix.time_s, *place)
        return
    last = None
    for message in log.messages(TELEMETRY) if TELEMETRY in log.topics else ():
        told = message.data.get("location")
        found = place_of(told) if isinstance(told, dict) and told != last else None
        if found is not None:
            last = told
            yield TrackPoint(start + message.time_s, *found, number_at(told, ("altitude",)))


def track_of(log: FlightLog, name: str, description: str) -> Track:
    """Return the track, with the first position as the home, and the marks at their positions."""
    segments = list(segments_of(points_of(log)))
    places = []
    if segments:
        places.append(Place(segments[0][0], "home"))
        places += _marks(log, [point for segment in segments for point in segment])
    return Track(name, description, segments, places)


def _marks(log: FlightLog, points: list[TrackPoint]) -> Iterator[Place]:
    at = 0
    for message in log.messages(MARK) if MARK in log.topics else ():
        unix_s = log.start_unix_s + message.time_s
        while at + 1 < len(points) and points[at + 1].unix_s <= unix_s:
            at += 1
        text = message.data.get("text")
        yield Place(points[at], text if isinstance(text, str) and text else "mark")
