"""Lateral guidance: the bank that brings the aircraft onto its path, in wind."""

import math

from raspilot.navigation.airframe_model import AirframeModel
from raspilot.navigation.limits import limited
from up.earth import GRAVITY_M_S2
from up.flight_modes.demand import Bank, Circle, Course, Line
from up.flight_modes.navigation_file import Lateral
from up.flight_modes.navigation_state import NavigationState

MIN_L1_M = 12.0
MAX_L1_OF_RADIUS = 0.9
INTEGRAL_PERIODS, INTEGRAL_OF_L1 = 0.6, 0.3
"""Of the integral of the distance to a line: its time over the period, its limit over the L1
distance."""
MIN_RADIUS_M = 10.0
TURN_MEMORY_RAD = math.radians(150.0)
MAX_ERROR_RAD = 0.5 * math.pi
MAX_FAR_M = 1e7


class LateralGuidance:
    """L1 guidance (Park, Deyst, How 2004) as a demanded course, flown by the air's velocity.

    The reference point at the L1 distance gives the course over the ground; the wind triangle
    gives the heading that makes it good. Where no heading does, because the wind is stronger than
    the airspeed, the nearest one is flown, finally straight into the wind: no limit cycle. The
    air's velocity is the ground velocity minus the wind, in direction and length, so an error of
    the wind or of the airspeed causes no steady error of the track.
    """

    def __init__(self, config: Lateral, model: AirframeModel) -> None:
        self._config = config
        self._model = model
        omega = 2.0 * math.pi / config.period_s
        self._course_gain = 2.0 * config.damping * omega
        self._l1_s = 2.0 * config.damping / omega
        self._integral_s = INTEGRAL_PERIODS * config.period_s
        self.reset()

    def reset(self) -> None:
        self._last_turn = 0.0
        self._line: Line | None = None
        self._line_s = self._integral_m = 0.0

    def roll_deg(self, path: Line | Circle | Course | Bank, state: NavigationState) -> float:
        """Return the bank that the path requires, before the limits."""
        if isinstance(path, Bank):
            return path.roll_deg
        airspeed_m_s = max(state.airspeed_m_s, self._model.speeds.stall_m_s)
        course_rad, course_rate = self._course(path, state)
        wind_north, wind_east = state.wind_m_s
        air_north = state.velocity_m_s.north_m - wind_north
        air_east = state.velocity_m_s.east_m - wind_east
        through_air_m_s = math.hypot(air_north, air_east)
        if through_air_m_s < 0.5 * self._model.speeds.stall_m_s:
            through_air_m_s, heading_rad = airspeed_m_s, math.radians(state.heading_deg)
        else:
            heading_rad = math.atan2(air_east, air_north)
        bank_rad = math.radians(limited(state.roll_deg, -60.0, 60.0))
        turning = GRAVITY_M_S2 * math.tan(bank_rad) / airspeed_m_s
        heading_rad += turning * self._config.roll_delay_s
        wanted_rad, rate_factor = _heading(course_rad, through_air_m_s, wind_north, wind_east)
        error_rad = self._error(wanted_rad - heading_rad)
        error_rad = limited(error_rad, -MAX_ERROR_RAD, MAX_ERROR_RAD)
        rate = self._course_gain * error_rad + rate_factor * course_rate
        return math.degrees(math.atan(airspeed_m_s * rate / GRAVITY_M_S2))

    def limited(self, roll_deg: float, airspeed_m_s: float) -> float:
        """Return a bank within the limits of the airspeed and of the configuration."""
        speed_m_s = max(airspeed_m_s, 0.5 * self._model.speeds.stall_m_s)
        limit = min(self._config.bank_limit_deg, self._model.bank_limit_deg(speed_m_s))
        return limited(roll_deg, -limit, limit)

    def _error(self, error_rad: float) -> float:
        """Return the turn to make; almost opposite, the side of the last turn is kept."""
        error_rad = math.remainder(error_rad, 2.0 * math.pi)
        if abs(error_rad) > TURN_MEMORY_RAD and error_rad * self._last_turn < 0.0:
            error_rad += math.copysign(2.0 * math.pi, self._last_turn)
        self._last_turn = error_rad
        return error_rad

    def _course(self, path: Line | Circle | Course, state: NavigationState) -> tuple[float, float]:
        """Return the course over the ground (rad) and its rate along the path (rad/s)."""
        if isinstance(path, Course):
            return math.radians(path.course_deg), 0.0
        # Where the aircraft is when the bank that is demanded now begins to act.
        delay_s = self._config.roll_delay_s
        north_m = state.position.north_m + delay_s * state.velocity_m_s.north_m
        east_m = state.position.east_m + delay_s * state.velocity_m_s.east_m
        l1_m = max(MIN_L1_M, self._l1_s * state.ground_speed_m_s)
        if isinstance(path, Line):
            tangent = math.radians(path.course_deg)
            sine, cosine = math.sin(tangent), math.cos(tangent)
            right_m = cosine * _far(east_m - path.point.east_m) - sine * _far(
                north_m - path.point.north_m
            )
            right_m += self._integral(path, right_m, l1_m, state.time_s)
            return tangent - math.asin(limited(right_m / l1_m, -1.0, 1.0)), 0.0
        radius_m = path.radius_m if path.radius_m > MIN_RADIUS_M else MIN_RADIUS_M
        out_north = _far(north_m - path.centre.north_m)
        out_east = _far(east_m - path.centre.east_m)
        outside_m = math.hypot(out_north, out_east) - radius_m
        l1_m = limited(l1_m, 1.0, MAX_L1_OF_RADIUS * radius_m)
        side = 1.0 if path.is_clockwise else -1.0
        bearing = math.atan2(out_east, out_north)
        inward = math.asin(limited(outside_m / l1_m, -1.0, 1.0))
        away_m = radius_m
        if outside_m > 0.0:
            # From far away onto the tangent, not towards the centre.
            away_m += outside_m
            inward = min(inward, math.acos(radius_m / away_m))
        course = bearing + side * (0.5 * math.pi + inward)
        along_m_s = side * (
            math.cos(bearing) * state.velocity_m_s.east_m
            - math.sin(bearing) * state.velocity_m_s.north_m
        )
        # Far outside the rate belongs to a straight line.
        share = math.cos(inward)
        return course, side * share * (along_m_s if along_m_s > 0.0 else 0.0) / away_m

    def _integral(self, path: Line, beside_m: float, l1_m: float, time_s: float) -> float:
        """Return the integral of the distance beside the path, m.

        Without it a velocity that the estimate has slightly wrong, as in a wind that changes, is
        answered by a distance that stays.
        """
        if path is not self._line and path != self._line:
            self._line, self._line_s, self._integral_m = path, time_s, 0.0
        passed_s = limited(time_s - self._line_s, 0.0, 0.25)
        self._line_s = time_s
        limit_m = INTEGRAL_OF_L1 * l1_m
        if abs(beside_m) < limit_m:
            grown_m = self._integral_m + beside_m * passed_s / self._integral_s
            self._integral_m = limited(grown_m, -limit_m, limit_m)
        return self._integral_m


def _heading(
    course_rad: float, airspeed_m_s: float, wind_north: float, wind_east: float
) -> tuple[float, float]:
    """Return the heading (rad) for a course over the ground, and its rate over the course's."""
    sine, cosine = math.sin(course_rad), math.cos(course_rad)
    along = wind_north * cosine + wind_east * sine
    across = wind_east * cosine - wind_north * sine
    left = airspeed_m_s * airspeed_m_s - across * across
    forward = math.sqrt(left) if left > 0.0 else 0.0
    ground = max(0.0, along + forward)
    if ground == 0.0 and wind_north == 0.0 == wind_east:
        return course_rad, 1.0
    heading = math.atan2(ground * sine - wind_east, ground * cosine - wind_north)
    return heading, min(2.0, ground / forward) if forward > 0.0 else 0.0


def _far(distance_m: float) -> float:
    return limited(distance_m, -MAX_FAR_M, MAX_FAR_M)
