"""What a flight mode demands: a path, an attitude, or surfaces."""

from up.flight_modes.navigation_state import Point
from up.quick_dataclass import dataclass
from up.quick_init import quick_init


@dataclass(frozen=True, slots=True)
class Line:
    """The straight line through a point along a course (deg clockwise from north)."""

    point: Point
    course_deg: float


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle around a point; clockwise as seen from above."""

    centre: Point
    radius_m: float
    is_clockwise: bool = True


@dataclass(frozen=True, slots=True)
class Course:
    """A direction over the ground (deg clockwise from north), from wherever the aircraft is."""

    course_deg: float


@dataclass(frozen=True, slots=True)
class Bank:
    """A bank angle (deg, right wing down positive): a turn that needs no position."""

    roll_deg: float


@quick_init
@dataclass(frozen=True, slots=True)
class PathDemand:
    """A path, an altitude and an airspeed: the path controller turns them into an attitude.

    ``altitude_m`` is above sea level; None: hold ``climb_m_s``. ``airspeed_m_s`` None: the cruise
    speed of the configuration. Without motor the airspeed is held by pitch and the altitude is what
    results. ``bank_limit_deg`` is one below that of the configuration.
    """

    path: Line | Circle | Course | Bank
    altitude_m: float | None = None
    climb_m_s: float = 0.0
    airspeed_m_s: float | None = None
    motor: bool = True
    bank_limit_deg: float | None = None


@quick_init
@dataclass(frozen=True, slots=True)
class AttitudeDemand:
    """An attitude to hold (deg, right wing down and nose up positive).

    ``throttle`` is 0 to 1; None leaves it to the pilot's stick. ``rudder_us`` is the pilot's
    rudder stick, to which the yaw damper is added.
    """

    roll_deg: float
    pitch_deg: float
    throttle: float | None = None
    rudder_us: int = 1500


@dataclass(frozen=True, slots=True)
class SurfacesDemand:
    """Servo positions (us). Only the Raspberry Pi's own control loop carries them out."""

    ailerons_us: int
    elevator_us: int
    rudder_us: int
    throttle: float | None = None


Demand = PathDemand | AttitudeDemand | SurfacesDemand
