"""The track of the aircraft over the ground: length, speed, distance from home."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from up.earth import distance_m
from up.flight_log.flight_log import FlightLog
from up.flight_log.followed import Followed
from up.flight_log.frame_state import place_of
from up.flight_log.json_message import number_at

LOCATION = "up.location.update"
_STEP_M = 5.0
"""A smaller step is receiver noise: a standing aircraft covers no distance."""
_MAX_SPEED_M_S = 150.0
"""A faster step is a jump of the receiver."""
_JUMPS = 3
_SPEED_OVER_S = 2.0


@dataclass(frozen=True, slots=True)
class Fix:
    """A position, degrees (WGS 84); altitude m and speed m/s if the receiver reports them."""

    time_s: float
    latitude_deg: float
    longitude_deg: float
    altitude_m: float | None
    speed_m_s: float | None


@dataclass(frozen=True, slots=True)
class TrackStatistics:
    """Metres and metres per second; None if there are too few positions."""

    length_m: float | None
    farthest_m: float | None
    top_speed_m_s: float | None
    highest_m: float | None
    lowest_m: float | None


def fixes(log: FlightLog) -> Iterator[Fix]:
    """Yield the positions of the followed source; a repeated one does not count."""
    followed = Followed(log)
    last: tuple[float, float] | None = None
    for message in log.messages(LOCATION):
        place = place_of(message.data)
        if place is None or not followed.accepts("location", message.time_s, message.data):
            continue
        if place != last:
            last = place
            altitude_m = number_at(message.data, ("altitude",))
            yield Fix(message.time_s, *place, altitude_m, number_at(message.data, ("speed",)))


def track_statistics(log: FlightLog) -> TrackStatistics:
    """Return the track from the first position, which is home."""
    home = last = marked = None
    length_m = farthest_m = 0.0
    told_m_s: list[float] = []
    made_m_s = 0.0
    jumps = 0
    altitudes_m: list[float] = []
    for fix in fixes(log):
        if home is None or last is None or marked is None:
            home = last = marked = fix
        if _is_jump(last, fix):
            jumps += 1
            if jumps < _JUMPS:
                continue
            # It stays there: the earlier position was wrong, or none arrived for a long time.
            home = home if farthest_m else fix
            last = marked = fix
        jumps = 0
        if fix.altitude_m is not None:
            altitudes_m.append(fix.altitude_m)
        if fix.speed_m_s is not None:
            told_m_s.append(fix.speed_m_s)
        farthest_m = max(farthest_m, _between_m(home, fix))
        step_m = _between_m(last, fix)
        if step_m >= _STEP_M:
            length_m += step_m
            last = fix
        passed_s = fix.time_s - marked.time_s
        if passed_s >= _SPEED_OVER_S:
            made_m_s = max(made_m_s, _between_m(marked, fix) / passed_s)
            marked = fix
    if home is None:
        return TrackStatistics(None, None, None, None, None)
    return TrackStatistics(
        length_m,
        farthest_m,
        max(told_m_s) if told_m_s else made_m_s,
        max(altitudes_m, default=None),
        min(altitudes_m, default=None),
    )


def _is_jump(before: Fix, now: Fix) -> bool:
    passed_s = now.time_s - before.time_s
    return _between_m(before, now) > _STEP_M + _MAX_SPEED_M_S * max(passed_s, 0.1)


def _between_m(one: Fix, other: Fix) -> float:
    return distance_m(one.latitude_deg, one.longitude_deg, other.latitude_deg, other.longitude_deg)
