"""How one item of a mission is flown, and when it is done."""

from typing import Protocol

from raspilot.mission.legs import lead_m, turn_between_deg
from raspilot.navigation.planning import (
    course_to_deg,
    distance_m,
    ground_speed_m_s,
    left_along_m,
    turn_radius_m,
)
from up.flight_modes.demand import Circle, Course, Line, PathDemand
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import NavigationState, Point

ALTITUDE_M = 10.0
"""An altitude is reached within this."""
ON_CIRCLE_M, ON_CIRCLE_PART = 10.0, 0.2
EARLY_S = 3.0
"""A descent ends this time before the turn: the altitude follows late."""
EXIT_DEG = 15.0
MAX_EXIT_DEG = 400.0
"""A circle is left after so much more even if it never points to the next item."""


class ItemFlight(Protocol):
    """One item while it is flown."""

    def is_done(self, state: NavigationState, dt_s: float) -> bool:
        """Return whether the next item begins now."""

    def demand(self, state: NavigationState) -> PathDemand:
        """Return the present demand."""


class LineFlight:
    """The line to a waypoint. It climbs immediately, and descends evenly along the line.

    The turn to ``following`` begins before the point, or with ``is_over`` at it.
    """

    def __init__(
        self,
        config: NavigationConfig,
        start: Point,
        start_altitude_m: float,
        end: Point,
        end_altitude_m: float,
        airspeed_m_s: float | None,
        following: Point | None,
        *,
        is_over: bool,
    ) -> None:
        self._config = config
        self._end = end
        self._course_deg = course_to_deg(start, end)
        self._length_m = max(1.0, distance_m(start, end))
        self._altitude_m = end_altitude_m
        self._above_m = max(0.0, start_altitude_m - end_altitude_m)
        self._airspeed_m_s = airspeed_m_s
        self._next_deg: float | None = None
        if following is not None and not is_over and following != end:
            self._next_deg = course_to_deg(end, following)

    def is_done(self, state: NavigationState, dt_s: float) -> bool:
        return self._left_m(state) <= self._lead_m(state)

    def demand(self, state: NavigationState) -> PathDemand:
        early_m = self._lead_m(state) + EARLY_S * state.ground_speed_m_s
        part = max(0.0, min(1.0, (self._left_m(state) - early_m) / self._length_m))
        altitude_m = self._altitude_m + part * self._above_m
        line = Line(self._end, self._course_deg)
        return PathDemand(line, altitude_m, airspeed_m_s=self._airspeed_m_s)

    def _left_m(self, state: NavigationState) -> float:
        return left_along_m(state.position, self._end, self._course_deg)

    def _lead_m(self, state: NavigationState) -> float:
        if self._next_deg is None:
            return 0.0
        airspeed_m_s = self._airspeed_m_s or self._config.airspeed.cruise_m_s
        next_m_s = ground_speed_m_s(airspeed_m_s, self._next_deg, state.wind_m_s) or 0.0
        radius_m = turn_radius_m(self._config, max(state.ground_speed_m_s, next_m_s))
        turn_deg = turn_between_deg(self._course_deg, self._next_deg)
        delay_m = self._config.lateral.roll_delay_s * state.ground_speed_m_s
        return min(self._length_m, lead_m(radius_m, turn_deg) + delay_m)


class CircleFlight:
    """A circle, for some turns, for some time, or without end (both None).

    ``turned_deg`` and ``waited_s`` count from the first time on the circle. It is left towards
    ``following``, at its altitude.
    """

    def __init__(
        self,
        circle: Circle,
        altitude_m: float,
        airspeed_m_s: float | None = None,
        *,
        turns: float | None = None,
        time_s: float | None = None,
        following: Point | None = None,
    ) -> None:
        self._circle = circle
        self._demand = PathDemand(circle, altitude_m, airspeed_m_s=airspeed_m_s)
        self._altitude_m = altitude_m
        self._turns, self._time_s = turns, time_s
        is_apart = following and distance_m(circle.centre, following) > circle.radius_m
        self._following = following if is_apart else None
        self._bearing_deg: float | None = None
        self._satisfied_deg: float | None = None
        self.turned_deg = self.waited_s = 0.0

    def is_done(self, state: NavigationState, dt_s: float) -> bool:
        self._count(state, dt_s)
        if self._bearing_deg is None or not self._is_satisfied(state):
            return False
        if self._satisfied_deg is None:
            self._satisfied_deg = self.turned_deg
        if self._following is None:
            return True
        course_deg = course_to_deg(state.position, self._following)
        is_towards = turn_between_deg(state.course_deg, course_deg) < EXIT_DEG
        return is_towards or self.turned_deg > self._satisfied_deg + MAX_EXIT_DEG

    def demand(self, state: NavigationState) -> PathDemand:
        return self._demand

    def _count(self, state: NavigationState, dt_s: float) -> None:
        bearing_deg = course_to_deg(self._circle.centre, state.position)
        if self._bearing_deg is not None:
            turned_deg = (bearing_deg - self._bearing_deg + 180.0) % 360.0 - 180.0
            self.turned_deg += turned_deg if self._circle.is_clockwise else -turned_deg
            self.waited_s += dt_s
            self._bearing_deg = bearing_deg
            return
        off_m = abs(distance_m(self._circle.centre, state.position) - self._circle.radius_m)
        if off_m < max(ON_CIRCLE_M, ON_CIRCLE_PART * self._circle.radius_m):
            self._bearing_deg = bearing_deg

    def _is_satisfied(self, state: NavigationState) -> bool:
        if self._turns is None and self._time_s is None:
            return False
        return (
            abs(state.altitude_m - self._altitude_m) <= ALTITUDE_M
            and (self._turns is None or self.turned_deg >= 360.0 * self._turns)
            and (self._time_s is None or self.waited_s >= self._time_s)
        )


class ClimbFlight:
    """A climb along the present course."""

    def __init__(self, state: NavigationState, altitude_m: float) -> None:
        self._altitude_m = altitude_m
        self._demand = PathDemand(Course(state.course_deg), altitude_m)

    def is_done(self, state: NavigationState, dt_s: float) -> bool:
        return state.altitude_m >= self._altitude_m - ALTITUDE_M / 2

    def demand(self, state: NavigationState) -> PathDemand:
        return self._demand
