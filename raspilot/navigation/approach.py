"""The straight approach of a landing: a line into the wind and a height for each distance."""

from __future__ import annotations

import math

from raspilot.navigation.airframe_model import AirframeModel
from raspilot.navigation.planning import flyable_radius_m, ground_speed_m_s
from up.flight_modes.demand import Circle, Line
from up.flight_modes.flight_mode import Target
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import NavigationState, Point
from up.quick_dataclass import dataclass

STALL_FACTOR, WIND_SHARE = 1.3, 0.25
"""Airspeed of the approach: this times the stall speed, and a part of the wind for its gusts."""
MIN_GROUND_M_S = 3.0
"""A slower approach is drift; the fixes could not tell it from standing."""
POWERED_SHARE = 0.7
"""Slope flown with the motor over that of the glide: too much height can still be corrected."""
LEAD_M = 25.0
"""Way from the circle to where the descent begins."""


def approach_airspeed_m_s(config: NavigationConfig, wind_m_s: float) -> float:
    """Return the airspeed of the approach in this wind, within the limits."""
    speeds = config.airspeed
    wanted = STALL_FACTOR * speeds.stall_m_s + WIND_SHARE * wind_m_s
    return max(speeds.minimum_m_s, min(speeds.maximum_m_s, wanted))


@dataclass(frozen=True, slots=True)
class Approach:
    """A plan for one wind. ``slope`` is the glide over the ground without motor; the motor stays
    off for the last ``glide_m``, which begin at ``decision_m`` above the landing point."""

    goal: Target
    course_deg: float
    airspeed_m_s: float
    slope: float
    decision_m: float
    height_m: float

    @classmethod
    def plan(
        cls,
        config: NavigationConfig,
        goal: Target,
        state: NavigationState,
        decision_m: float,
        height_m: float,
    ) -> Approach:
        """Plan into the wind that is estimated now."""
        airspeed = approach_airspeed_m_s(config, state.wind_speed_m_s)
        course_deg = state.wind_from_deg
        ground = ground_speed_m_s(airspeed, course_deg, state.wind_m_s) or MIN_GROUND_M_S
        sink = AirframeModel(config).sink_m_s(airspeed, 1.0)
        slope = sink / max(MIN_GROUND_M_S, ground)
        return cls(goal, course_deg, airspeed, slope, decision_m, height_m)

    @property
    def line(self) -> Line:
        return Line(self.goal.point, self.course_deg)

    @property
    def glide_m(self) -> float:
        return self.decision_m / self.slope

    @property
    def length_m(self) -> float:
        """Return how long the approach is, from the circle to the landing point."""
        powered_m = (self.height_m - self.decision_m) / (POWERED_SHARE * self.slope)
        return self.glide_m + powered_m + LEAD_M

    def height_at_m(self, to_go_m: float) -> float:
        """Return the height above the landing point at a distance from it."""
        if to_go_m < self.glide_m:
            return self.slope * to_go_m
        height = self.decision_m + POWERED_SHARE * self.slope * (to_go_m - self.glide_m)
        return min(self.height_m, height)

    def sink_m_s(self, to_go_m: float, ground_m_s: float) -> float:
        if to_go_m < self.glide_m:
            return self.slope * ground_m_s
        return POWERED_SHARE * self.slope * ground_m_s if to_go_m < self.length_m - LEAD_M else 0.0

    def place_of(self, at: Point) -> tuple[float, float]:
        """Return how far it is to go along the line, and how far to the right of it."""
        course = math.radians(self.course_deg)
        north_m, east_m = at.north_m - self.goal.point.north_m, at.east_m - self.goal.point.east_m
        sine, cosine = math.sin(course), math.cos(course)
        return -(north_m * cosine + east_m * sine), east_m * cosine - north_m * sine

    def turn(
        self, config: NavigationConfig, state: NavigationState, radius_m: float, is_clockwise: bool
    ) -> Circle:
        """Return the circle that leads onto the line where the approach begins."""
        radius_m = flyable_radius_m(config, state, radius_m)
        side_m = radius_m if is_clockwise else -radius_m
        course = math.radians(self.course_deg)
        sine, cosine = math.sin(course), math.cos(course)
        centre = Point(
            self.goal.point.north_m - self.length_m * cosine - side_m * sine,
            self.goal.point.east_m - self.length_m * sine + side_m * cosine,
        )
        return Circle(centre, radius_m, is_clockwise)
