"""CRUISE: holds course and altitude until sticks or ground change them."""

from raspilot.flight_controller.sticks import deflection
from up.flight_modes.demand import Bank, Course, Demand, Line, PathDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation
from up.flight_modes.navigation_file import NAVIGATION
from up.flight_modes.navigation_state import NavigationState

DEADBAND = 0.08
LEVEL_DEG = 5.0


class Cruise(FlightMode):
    """Holds a line over the ground.

    Ailerons require a bank, elevator a climb; when they are released the aircraft holds the course
    and the altitude that it has then. Required course and altitude act when they change.
    """

    NAME = "CRUISE"
    NEEDS = {"navigation": 3.0, "orientation": 1.0}
    FALLBACK = "FBW"
    REQUESTS = frozenset({"course", "altitude"})

    def enter(self, situation: FlightSituation) -> None:
        state = situation.navigation
        assert state is not None
        self._path: Line | Course | None = None
        self._course_deg: float | None = None
        self._altitude_m: float | None = state.altitude_m
        self._required = (situation.required_course_deg, situation.required_altitude_m)

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        state, rx = situation.navigation, situation.rx
        assert state is not None
        config = self.context.config(NAVIGATION)
        self._follow_requests(situation, state)
        turn = climb = 0.0
        if rx is not None:
            turn, climb = _stick(rx.ailerons_us), _stick(rx.elevator_us)
        limits = config.vertical
        climb_m_s = climb * (limits.climb_limit_m_s if climb > 0 else limits.sink_limit_m_s)
        if climb:
            self._altitude_m = None
        elif self._altitude_m is None:
            self._altitude_m = state.altitude_m
        if turn:
            self._path = self._course_deg = None
            bank = Bank(turn * config.lateral.bank_limit_deg)
            return PathDemand(bank, self._altitude_m, climb_m_s)
        return PathDemand(self._held(state), self._altitude_m, climb_m_s)

    def _follow_requests(self, situation: FlightSituation, state: NavigationState) -> None:
        course_deg, altitude_m = situation.required_course_deg, situation.required_altitude_m
        if course_deg is not None and course_deg != self._required[0]:
            self._course_deg, self._path = course_deg, None
        if altitude_m is not None and altitude_m != self._required[1]:
            self._altitude_m = altitude_m
        self._required = (course_deg, altitude_m)

    def _held(self, state: NavigationState) -> Line | Course | Bank:
        """Return the line; while the wings are not level yet, what leads to it."""
        if self._path is None:
            if self._course_deg is None:
                if abs(state.roll_deg) > LEVEL_DEG:
                    return Bank(0.0)
                self._course_deg = state.course_deg
            off_deg = (state.course_deg - self._course_deg + 180.0) % 360.0 - 180.0
            if abs(off_deg) > LEVEL_DEG:
                return Course(self._course_deg)
            self._path = Line(state.position, self._course_deg)
        return self._path


def _stick(pulse_us: int) -> float:
    part = deflection(pulse_us)
    return part if abs(part) > DEADBAND else 0.0
