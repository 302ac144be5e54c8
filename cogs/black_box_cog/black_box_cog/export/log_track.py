"""The track that a flight's log tells."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from black_box_cog.export.track import Place, Track, TrackPoint, segments_of
from up.flight_log.flight_log import FlightLog
from up.flight_log.json_message import number_at

LOCATION, TELEMETRY, MARK = "up.location.update", "up.telemetry.update", "black_box.mark"


def points_of(log: FlightLog) -> Iterator[TrackPoint]:
    """Yield the positions in the order of time, as the aircraft's sources told them.

    Where no source was logged, those of telemetry; a place that was told twice counts once.
    """
    if LOCATION in log.topics:
        for message in log.messages(LOCATION):
            point = _point(message.data, log.start_unix_s + message.time_s)
            if point is not None:
                yield point
        return
    last = None
    for message in log.messages(TELEMETRY):
        place = message.data.get("location")
        if isinstance(place, dict) and place != last:
            last = place
            point = _point(place, log.start_unix_s + message.time_s)
            if point is not None:
                yield point


def track_of(log: FlightLog, name: str, description: str) -> Track:
    """Return the track, with the first position as the home and the marks where they were set."""
    segments = list(segments_of(points_of(log)))
    places = []
    if segments:
        places.append(Place(segments[0][0], "home"))
        places += _marks(log, [point for segment in segments for point in segment])
    return Track(name, description, segments, places)


def _point(data: Mapping[str, Any], unix_s: float) -> TrackPoint | None:
    latitude_deg, longitude_deg = _number(data, "latitude"), _number(data, "longitude")
    if latitude_deg is None or longitude_deg is None:
        return None
    return TrackPoint(
        unix_s,
        latitude_deg,
        longitude_deg,
        _number(data, "altitude"),
        _number(data, "speed"),
        _number(data, "bearing"),
    )


def _marks(log: FlightLog, points: list[TrackPoint]) -> Iterator[Place]:
    at = 0
    for message in log.messages(MARK) if MARK in log.topics else ():
        unix_s = log.start_unix_s + message.time_s
        while at + 1 < len(points) and points[at + 1].unix_s <= unix_s:
            at += 1
        text = message.data.get("text")
        yield Place(points[at], text if isinstance(text, str) and text else "mark")


def _number(data: Mapping[str, Any], key: str) -> float | None:
    return number_at(data, (key,))
