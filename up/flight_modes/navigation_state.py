"""What the navigation estimator knows at one instant."""

import math
from typing import NamedTuple

from up.earth import MEAN_RADIUS_M
from up.quick_dataclass import dataclass
from up.quick_init import quick_init


class Point(NamedTuple):
    """A position in metres from the origin of a LocalFrame."""

    north_m: float
    east_m: float


@dataclass(frozen=True, slots=True)
class LocalFrame:
    """A plane that touches the Earth (WGS 84 degrees): exact to 0.1 % within 100 km."""

    latitude_deg: float
    longitude_deg: float

    def point(self, latitude_deg: float, longitude_deg: float) -> Point:
        east_deg = (longitude_deg - self.longitude_deg + 180.0) % 360.0 - 180.0
        cosine = math.cos(math.radians(self.latitude_deg))
        return Point(
            math.radians(latitude_deg - self.latitude_deg) * MEAN_RADIUS_M,
            math.radians(east_deg) * MEAN_RADIUS_M * cosine,
        )

    def degrees(self, point: Point) -> tuple[float, float]:
        cosine = math.cos(math.radians(self.latitude_deg))
        latitude = self.latitude_deg + math.degrees(point.north_m / MEAN_RADIUS_M)
        longitude = self.longitude_deg + math.degrees(point.east_m / (MEAN_RADIUS_M * cosine))
        return latitude, (longitude + 180.0) % 360.0 - 180.0


@quick_init
@dataclass(frozen=True, slots=True)
class NavigationState:
    """Position, velocity, wind and attitude now, each with its standard deviation (``_sd``).

    Positions are in ``frame``; altitudes above sea level, as the receiver reports them. The wind
    is the velocity of the air over the ground. ``fix_age_s`` is the time since the newest accepted
    fix was taken: until the next one the position is dead reckoning. ``motor_stopped``: the motor
    gives no thrust although the throttle is open; ``motor_watched``: a stop would be noticed now.
    ``measured_airspeed_m_s`` is the horizontal one
    along the nose, from the ground velocity of a fix less the wind, not from the model; None
    without such a fix. ``is_in_flight``: the ground speed has shown a flight, and no landing since.
    """

    time_s: float
    frame: LocalFrame
    position: Point
    velocity_m_s: Point
    altitude_m: float
    climb_m_s: float
    wind_m_s: Point
    airspeed_m_s: float
    heading_deg: float
    roll_deg: float
    pitch_deg: float
    position_sd_m: float
    altitude_sd_m: float
    wind_sd_m_s: float
    airspeed_sd_m_s: float
    heading_sd_deg: float
    fix_age_s: float
    motor_stopped: bool = False
    motor_watched: bool = True
    measured_airspeed_m_s: float | None = None
    is_in_flight: bool = True

    @property
    def ground_speed_m_s(self) -> float:
        return math.hypot(*self.velocity_m_s)

    @property
    def course_deg(self) -> float:
        """Return the direction of the ground velocity, deg clockwise from north, 0 to 360."""
        north, east = self.velocity_m_s
        return math.degrees(math.atan2(east, north)) % 360.0

    @property
    def wind_speed_m_s(self) -> float:
        return math.hypot(*self.wind_m_s)

    @property
    def wind_from_deg(self) -> float:
        """Return the direction that the wind comes from, deg clockwise from north, 0 to 360."""
        north, east = self.wind_m_s
        return math.degrees(math.atan2(-east, -north)) % 360.0
