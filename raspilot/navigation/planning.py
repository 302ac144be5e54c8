"""Circles and banks that can be flown, and airspeeds for the wind."""

import math

from raspilot.navigation.airframe_model import AirframeModel
from up.earth import GRAVITY_M_S2
from up.flight_modes.demand import Circle
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import NavigationState, Point

BANK_RESERVE = 0.8
"""Part of the bank limit that a steady circle may need."""
AVIONICS_M_S = 0.3
"""What receiver, computer and radio use in addition to the motor, as a sink."""
AIRSPEED_STEP_M_S = 0.5
SETTLE_S = 1.0
NEAR_BANK_DEG, BANK_DEG_PER_M = 8.0, 4.0
"""Bank limit at the ground, and how it grows with the height."""


def distance_m(a: Point, b: Point) -> float:
    """Return the distance over the ground."""
    return math.hypot(a.north_m - b.north_m, a.east_m - b.east_m)


def course_to_deg(a: Point, b: Point) -> float:
    """Return the course from a to b, 0 to 360 degrees."""
    return math.degrees(math.atan2(b.east_m - a.east_m, b.north_m - a.north_m)) % 360.0


def ground_speed_m_s(airspeed_m_s: float, course_deg: float, wind: Point) -> float | None:
    """Return the speed along a course; None if the wind does not permit the course."""
    course = math.radians(course_deg)
    along = wind.north_m * math.cos(course) + wind.east_m * math.sin(course)
    across = wind.east_m * math.cos(course) - wind.north_m * math.sin(course)
    if abs(across) >= airspeed_m_s:
        return None
    speed = along + math.sqrt(airspeed_m_s * airspeed_m_s - across * across)
    return speed if speed > 0.0 else None


def airspeed_for_wind_m_s(
    config: NavigationConfig, course_deg: float, wind: Point, *, motor: bool
) -> float:
    """Return the airspeed that needs the least energy for a way along a course.

    With the motor it is cruise or above, without best glide or above; the greatest one if the wind
    does not permit the course.
    """
    model, speeds = AirframeModel(config), config.airspeed
    least = speeds.cruise_m_s if motor else max(speeds.minimum_m_s, speeds.best_glide_m_s)
    best, best_cost = speeds.maximum_m_s, math.inf
    airspeed = least
    while airspeed <= speeds.maximum_m_s:
        ground = ground_speed_m_s(airspeed, course_deg, wind)
        if ground is not None:
            power = model.sink_m_s(airspeed, 1.0) + (AVIONICS_M_S if motor else 0.0)
            if power / ground < best_cost:
                best, best_cost = airspeed, power / ground
        airspeed += AIRSPEED_STEP_M_S
    return best


def left_along_m(position: Point, end: Point, course_deg: float) -> float:
    """Return how far a point is ahead along a course; negative: it is behind."""
    course = math.radians(course_deg)
    north_m, east_m = end.north_m - position.north_m, end.east_m - position.east_m
    return north_m * math.cos(course) + east_m * math.sin(course)


def flyable_radius_m(config: NavigationConfig, state: NavigationState, radius_m: float) -> float:
    """Return the radius, or the least one that bank limit, airspeed and wind permit."""
    fastest = config.airspeed.cruise_m_s + math.hypot(*state.wind_m_s)
    return max(radius_m, turn_radius_m(config, fastest))


def turn_radius_m(config: NavigationConfig, ground_speed_m_s: float) -> float:
    """Return the radius of a turn with some bank in reserve."""
    bank = math.radians(BANK_RESERVE * config.lateral.bank_limit_deg)
    return ground_speed_m_s * ground_speed_m_s / (GRAVITY_M_S2 * math.tan(bank))


def circle_abeam(config: NavigationConfig, state: NavigationState, radius_m: float) -> Circle:
    """Return the circle that begins here, to the side of the present bank."""
    radius_m = flyable_radius_m(config, state, radius_m)
    speed = max(1.0, state.ground_speed_m_s)
    ahead_north = state.velocity_m_s.north_m / speed
    ahead_east = state.velocity_m_s.east_m / speed
    settle_m = SETTLE_S * state.ground_speed_m_s
    is_clockwise = state.roll_deg >= 0.0
    side_m = radius_m if is_clockwise else -radius_m
    centre = Point(
        state.position.north_m + settle_m * ahead_north - side_m * ahead_east,
        state.position.east_m + settle_m * ahead_east + side_m * ahead_north,
    )
    return Circle(centre, radius_m, is_clockwise)


def circle_around(
    config: NavigationConfig, state: NavigationState, centre: Point, radius_m: float
) -> Circle:
    """Return the circle around a point, on the side that needs the least turning."""
    north_m = centre.north_m - state.position.north_m
    east_m = centre.east_m - state.position.east_m
    right_m = state.velocity_m_s.north_m * east_m - state.velocity_m_s.east_m * north_m
    return Circle(centre, flyable_radius_m(config, state, radius_m), right_m >= 0.0)


def ground_bank_deg(height_m: float, sd_m: float) -> float:
    """Return the greatest bank for the height that is certain: near the ground a wing is low."""
    return NEAR_BANK_DEG + BANK_DEG_PER_M * max(0.0, height_m - sd_m)
