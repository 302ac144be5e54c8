"""LAND: descends in a circle, then glides to the ground against the wind."""

import math
from collections.abc import Iterator
from enum import Enum

from raspilot.navigation.airframe_model import AirframeModel
from raspilot.navigation.approach import MIN_GROUND_M_S, Approach, approach_airspeed_m_s
from raspilot.navigation.planning import circle_around, distance_m, ground_bank_deg
from up.config import ConfigFile, key
from up.flight_modes.demand import AttitudeDemand, Circle, Course, Demand, PathDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation, ModeRefusal, Target
from up.flight_modes.navigation_file import NAVIGATION
from up.flight_modes.navigation_state import NavigationState
from up.flight_modes.selector import DemandError
from up.quick_dataclass import dataclass

MAX_FIX_AGE_S = 3.0
SETTLED_M = 4.0
KNOWN_WIND_SD_M_S = 1.0
ALIGNED_DEG, BEGIN_OFF_M = 15.0, 30.0
HEIGHT_GAIN = 0.3
FINAL_BANK_DEG = 25.0
MAX_OFF_COURSE_DEG = 25.0
CALM_M_S = 2.0


@dataclass(frozen=True, slots=True)
class LandConfig:
    """The mode LAND."""

    radius_m: float = key(50.0, "Radius of the circles.", unit="m", minimum=15, maximum=500)
    height_m: float = key(
        25.0, "Height above the landing point at which the approach begins.", unit="m",
        minimum=12, maximum=200,
    )  # fmt: skip
    decision_height_m: float = key(
        7.0, "There it goes around, or lands: below it the motor stays off. At least twice the"
        " error of the altitude.", unit="m", minimum=3, maximum=50,
    )  # fmt: skip
    max_aside_m: float = key(
        12.0, "Farther beside the approach it goes around.", unit="m", minimum=3, maximum=100
    )
    max_height_error_m: float = key(
        6.0, "Farther above or below the approach it goes around.", unit="m", minimum=2, maximum=50
    )
    max_distance_m: float = key(
        5000.0, "A landing point farther away is refused.", unit="m", minimum=100, maximum=50_000
    )
    max_slope_m: float = key(
        30.0, "A landing point farther above or below home is refused.", unit="m", minimum=5,
        maximum=1000,
    )  # fmt: skip

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.height_m < self.decision_height_m + 2:
            yield "height_m", "must be at least 2 m above decision_height_m"


LAND = ConfigFile("land.yml", LandConfig)


class _Stage(Enum):
    CIRCLE, TURN, FINAL, GLIDE, GROUND = range(5)


class Land(FlightMode):
    """Lands at the target, else at home: the altitude of either is that of the ground.

    It circles there until height and wind are known, turns onto the approach, and decides at the
    decision height: it goes around, or closes the throttle for good and glides to the ground with
    the wings near level. It does not flare: the height of a phone is too uncertain. A LAND that is
    entered below the decision height glides straight on, so that a restart of the program never
    starts the motor on the ground.
    """

    NAME = "LAND"
    FALLBACK = "CIRCLE"
    REQUESTS = frozenset({"target"})
    CONFIG = LAND

    _goal: Target | None = None
    _path: Circle | None = None

    @property
    def is_uninterrupted(self) -> bool:
        return True

    @property
    def goal(self) -> Target | None:
        return self._goal

    def refusal(self, situation: FlightSituation) -> ModeRefusal | None:
        state, home, limits = situation.navigation, situation.home, self.config
        goal = _goal_of(situation)
        if home is None or goal is None:
            return ModeRefusal("no_home", "no home is set; send up.home.set")
        if state is None or state.fix_age_s > MAX_FIX_AGE_S:
            return ModeRefusal("navigation", "the position is unknown")
        if not state.is_in_flight:
            return ModeRefusal("on_ground", "the aircraft is on the ground")
        away_m = distance_m(state.position, goal.point)
        if not away_m <= limits.max_distance_m:
            code = "home_too_far" if situation.target is None else "target_too_far"
            text = f"the landing point is {away_m / 1000:.1f} km away (land.yml: max_distance_m)"
            return ModeRefusal(code, text)
        above_m = goal.altitude_m - home.altitude_m
        if not abs(above_m) <= limits.max_slope_m:
            code = "target_too_high" if above_m > 0 else "target_too_low"
            text = f"it is {above_m:+.0f} m from home (land.yml: max_slope_m)"
            return ModeRefusal(code, text)
        wind_m_s = state.wind_speed_m_s
        airspeed_m_s = approach_airspeed_m_s(self.context.config(NAVIGATION), wind_m_s)
        if airspeed_m_s - wind_m_s < MIN_GROUND_M_S:
            text = f"the wind of {wind_m_s:.0f} m/s leaves no approach at {airspeed_m_s:.0f} m/s"
            return ModeRefusal("wind_too_strong", text)
        return None

    def enter(self, situation: FlightSituation) -> None:
        self._navigation = self.context.config(NAVIGATION)
        self._model = AirframeModel(self._navigation)
        self._plan: Approach | None = None
        self._has_flown = False
        self._begin(situation)
        state = situation.navigation
        if state is not None and self._height_m(state) < self.config.decision_height_m:
            self._commit(state)

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        state = situation.navigation
        if state is not None:
            self._has_flown = self._has_flown or state.is_in_flight
            if self._has_flown and not state.is_in_flight:
                self._stage = _Stage.GROUND
        if self._stage is _Stage.GROUND:
            return AttitudeDemand(0.0, 0.0, 0.0)
        if self._stage is _Stage.GLIDE:
            return self._glide(state)
        if state is None or state.fix_age_s > MAX_FIX_AGE_S:
            raise DemandError("the position is too old for an approach", "navigation")
        if self._stage is _Stage.CIRCLE and _goal_of(situation) != self._goal:
            self._begin(situation)
        has_motor = self._model.has_motor and not state.motor_stopped
        if self._stage is _Stage.FINAL:
            self._decide(situation, state, has_motor)
        elif not has_motor and self._height_m(state) < self.config.decision_height_m:
            self._commit(state)
        if self._stage is _Stage.CIRCLE:
            return self._descend(situation, state, has_motor)
        if self._stage is _Stage.TURN:
            return self._turn(state)
        return self._approach(state) if self._stage is _Stage.FINAL else self._glide(state)

    def _begin(self, situation: FlightSituation) -> None:
        self._goal = _goal_of(situation)
        self._stage, self._path = _Stage.CIRCLE, None
        self._settled_s: float | None = None

    def _commit(self, state: NavigationState) -> None:
        """From here on the motor stays off."""
        self._stage = _Stage.GLIDE
        is_calm = state.wind_speed_m_s < CALM_M_S
        self._straight = Course(state.course_deg if is_calm else state.wind_from_deg)
        self.log.info("lands: the motor stays off", code="landing_committed")

    def _height_m(self, state: NavigationState) -> float:
        return state.altitude_m - self._goal.altitude_m if self._goal else math.inf

    def _descend(
        self, situation: FlightSituation, state: NavigationState, has_motor: bool
    ) -> Demand:
        goal, limits = self._goal, self.config
        if goal is None:
            raise DemandError("there is no landing point", "no_home")
        if self._path is None:
            self._path = circle_around(self._navigation, state, goal.point, limits.radius_m)
        circle = self._path
        off_m = abs(distance_m(state.position, goal.point) - circle.radius_m)
        above_m = self._height_m(state) - limits.height_m
        is_low = above_m < SETTLED_M and (above_m > -SETTLED_M or not has_motor)
        if not is_low or off_m > 0.5 * circle.radius_m:
            self._settled_s = None
        elif self._settled_s is None:
            self._settled_s = situation.time_s
        elif situation.time_s - self._settled_s > self._turn_s(state, circle):
            self._plan = Approach.plan(
                self._navigation, goal, state, limits.decision_height_m, limits.height_m
            )
            self._path = self._plan.turn(
                self._navigation, state, limits.radius_m, circle.is_clockwise
            )
            self._stage = _Stage.TURN
        return self._demand(state, circle)

    def _turn_s(self, state: NavigationState, circle: Circle) -> float:
        """Return how long it circles at the height: a turn, unless the wind is known."""
        if state.wind_sd_m_s < KNOWN_WIND_SD_M_S:
            return 0.0
        return 2.0 * math.pi * circle.radius_m / self._model.speeds.cruise_m_s

    def _turn(self, state: NavigationState) -> Demand:
        plan, circle = self._plan, self._path
        assert plan is not None and circle is not None
        to_go_m, aside_m = plan.place_of(state.position)
        is_aligned = _off_deg(state.course_deg, plan.course_deg) < ALIGNED_DEG
        if is_aligned and abs(aside_m) < BEGIN_OFF_M and to_go_m > plan.length_m - BEGIN_OFF_M:
            self._stage = _Stage.FINAL
        return self._demand(state, circle)

    def _decide(self, situation: FlightSituation, state: NavigationState, has_motor: bool) -> None:
        """At the decision height, or where it should be reached, land or go around."""
        plan, limits = self._plan, self.config
        assert plan is not None
        to_go_m, aside_m = plan.place_of(state.position)
        height_m = self._height_m(state)
        if height_m > limits.decision_height_m and to_go_m > plan.glide_m:
            return
        causes = {
            "aside": abs(aside_m) > limits.max_aside_m,
            "course": _off_deg(state.course_deg, plan.course_deg) > MAX_OFF_COURSE_DEG,
            "height": abs(height_m - plan.height_at_m(to_go_m)) > limits.max_height_error_m,
        }
        if has_motor and any(causes.values()):
            cause = ", ".join(name for name, holds in causes.items() if holds)
            self.log.warn("goes around: {cause}", cause=cause, code="go_around")
            self._begin(situation)
        else:
            self._commit(state)

    def _approach(self, state: NavigationState) -> Demand:
        plan = self._plan
        assert plan is not None
        to_go_m, _ = plan.place_of(state.position)
        error_m = plan.height_at_m(to_go_m) - self._height_m(state)
        climb_m_s = HEIGHT_GAIN * error_m - plan.sink_m_s(to_go_m, state.ground_speed_m_s)
        return PathDemand(
            plan.line, None, climb_m_s, plan.airspeed_m_s,
            bank_limit_deg=min(FINAL_BANK_DEG, self._bank_limit_deg(state)),
        )  # fmt: skip

    def _glide(self, state: NavigationState | None) -> Demand:
        wind_m_s = 0.0 if state is None else state.wind_speed_m_s
        plan = self._plan
        airspeed_m_s = approach_airspeed_m_s(self._navigation, wind_m_s)
        if plan is not None:
            airspeed_m_s = plan.airspeed_m_s
        if state is None:
            return AttitudeDemand(0.0, self._model.glide_pitch_deg(airspeed_m_s, 1.0), 0.0)
        return PathDemand(
            self._straight if plan is None else plan.line, airspeed_m_s=airspeed_m_s, motor=False,
            bank_limit_deg=min(FINAL_BANK_DEG, self._bank_limit_deg(state)),
        )  # fmt: skip

    def _demand(self, state: NavigationState, circle: Circle) -> Demand:
        assert self._goal is not None
        altitude_m = self._goal.altitude_m + self.config.height_m
        return PathDemand(circle, altitude_m, bank_limit_deg=self._bank_limit_deg(state))

    def _bank_limit_deg(self, state: NavigationState) -> float:
        return ground_bank_deg(self._height_m(state), state.altitude_sd_m)


def _goal_of(situation: FlightSituation) -> Target | None:
    home, target = situation.home, situation.target
    if target is not None or home is None:
        return target
    return Target(home.point, home.altitude_m)


def _off_deg(course_deg: float, wanted_deg: float) -> float:
    return abs(math.remainder(course_deg - wanted_deg, 360.0))
