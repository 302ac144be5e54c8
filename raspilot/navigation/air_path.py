"""The path through the air as running integrals, with their recent past."""

import cmath
import math
from bisect import bisect_right
from typing import NamedTuple

KEPT_S = 4.0
MAX_GAP_S = 0.5
"""Longest time without orientation through which the motion is known."""
_SPARE = 400


class AirPoint(NamedTuple):
    """The integrals at one time, and the motion through the air; angles as by the board's yaw.

    ``north_m``, ``east_m`` and ``climb_m`` are the distance through the air; ``thrust_m_s`` the
    airspeed that a working motor has given, ``coast_m_s`` the one that drag and climb have.
    ``unseen_s`` is the time of all gaps in the orientation longer than ``MAX_GAP_S``.
    """

    time_s: float
    north_m: float
    east_m: float
    climb_m: float
    thrust_m_s: float
    coast_m_s: float
    north_m_s: float
    east_m_s: float
    yaw_deg: float
    unseen_s: float = 0.0


class AirPath:
    """The last ``KEPT_S`` at least; what happened since a fix is the difference of two points."""

    def __init__(self) -> None:
        self._times: list[float] = []
        self._points: list[AirPoint] = []

    @property
    def newest(self) -> AirPoint | None:
        return self._points[-1] if self._points else None

    def append(self, point: AirPoint) -> None:
        """Add a point later than the newest."""
        self._times.append(point.time_s)
        self._points.append(point)
        if len(self._times) > _SPARE and self._times[_SPARE // 2] < point.time_s - KEPT_S:
            del self._times[: _SPARE // 2], self._points[: _SPARE // 2]

    def at(self, time_s: float) -> AirPoint | None:
        """Return the interpolated point; None if the time is before the buffer.

        After the newest point the motion continues straight.
        """
        times, points = self._times, self._points
        after = bisect_right(times, time_s)
        if after == 0:
            return None
        left = points[after - 1]
        passed_s = time_s - left.time_s
        if passed_s == 0.0:
            return left
        if after == len(points):
            return left._replace(
                time_s=time_s,
                north_m=left.north_m + left.north_m_s * passed_s,
                east_m=left.east_m + left.east_m_s * passed_s,
                unseen_s=left.unseen_s + (passed_s if passed_s > MAX_GAP_S else 0.0),
            )
        right = points[after]
        share = passed_s / (right.time_s - left.time_s)
        # The yaw and the velocity of the nearer point: 20 ms apart, and the yaw wraps.
        near = right if share > 0.5 else left
        return AirPoint(
            time_s,
            left.north_m + share * (right.north_m - left.north_m),
            left.east_m + share * (right.east_m - left.east_m),
            left.climb_m + share * (right.climb_m - left.climb_m),
            left.thrust_m_s + share * (right.thrust_m_s - left.thrust_m_s),
            left.coast_m_s + share * (right.coast_m_s - left.coast_m_s),
            near.north_m_s,
            near.east_m_s,
            near.yaw_deg,
            left.unseen_s + share * (right.unseen_s - left.unseen_s),
        )

    def multiply(self, factor: complex) -> None:
        """Turn and stretch the whole past by a complex number (north + i east)."""
        self._points = [multiplied(point, factor) for point in self._points]


def multiplied(point: AirPoint, factor: complex) -> AirPoint:
    """Return a point as if the path had always been turned and stretched."""
    path = complex(point.north_m, point.east_m) * factor
    velocity = complex(point.north_m_s, point.east_m_s) * factor
    return point._replace(
        north_m=path.real,
        east_m=path.imag,
        north_m_s=velocity.real,
        east_m_s=velocity.imag,
        yaw_deg=point.yaw_deg + math.degrees(cmath.phase(factor)),
    )
