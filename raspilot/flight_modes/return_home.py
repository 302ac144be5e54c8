"""RETURN: climbs, flies home and circles there, or lands."""

from raspilot.navigation.planning import (
    airspeed_for_wind_m_s,
    circle_around,
    course_to_deg,
    distance_m,
)
from up.config import ConfigFile, key
from up.flight_modes.demand import Demand, PathDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation, ModeRefusal
from up.flight_modes.navigation_file import NAVIGATION
from up.quick_dataclass import dataclass

AIRSPEED_PERIOD_S = 1.0
ARRIVED_RADII = 2.0


@dataclass(frozen=True, slots=True)
class ReturnConfig:
    """The mode RETURN."""

    height_m: float = key(
        60.0, "Return height above home; it climbs while it turns home.", unit="m", minimum=10,
        maximum=2000,
    )  # fmt: skip
    radius_m: float = key(50.0, "Radius of the circle at home.", unit="m", minimum=15, maximum=500)
    max_distance_m: float = key(
        50_000.0, "A home farther away is refused.", unit="m", minimum=1000, maximum=100_000
    )
    land: bool = key(False, "At home, lands by the mode LAND instead of circling.")


RETURN = ConfigFile("return.yml", ReturnConfig)


class Return(FlightMode):
    """Flies home at return height or above it, descends there to return height and circles.

    The airspeed is the one that needs the least energy in the wind, cruise or above.
    """

    NAME = "RETURN"
    NEEDS = {"navigation": 3.0, "orientation": 1.0}
    FALLBACK = "CIRCLE"
    CONFIG = RETURN

    def refusal(self, situation: FlightSituation) -> ModeRefusal | None:
        home, state = situation.home, situation.navigation
        if home is None:
            return ModeRefusal("no_home", "no home is set; send up.home.set")
        if state is None:
            return ModeRefusal("navigation", "the position is unknown")
        away_m = distance_m(state.position, home.point)
        if not away_m <= self.config.max_distance_m:
            return ModeRefusal(
                "home_too_far",
                f"home is {away_m / 1000:.1f} km away, more than"
                f" {self.config.max_distance_m / 1000:g} km (return.yml: max_distance_m)",
            )
        return None

    def enter(self, situation: FlightSituation) -> None:
        home, state = situation.home, situation.navigation
        assert home is not None
        assert state is not None
        self._home = home
        self._navigation = self.context.config(NAVIGATION)
        self._circle = circle_around(self._navigation, state, home.point, self.config.radius_m)
        self._lowest_m = home.altitude_m + self.config.height_m
        self._altitude_m = max(self._lowest_m, state.altitude_m)
        self._airspeed_m_s: float | None = None
        self._chosen_s = float("-inf")
        self.successor = ""

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        home, state = situation.home, situation.navigation
        assert state is not None
        if home is not None and home != self._home:
            self.enter(situation)
        if situation.time_s - self._chosen_s >= AIRSPEED_PERIOD_S:
            self._chosen_s = situation.time_s
            self._choose_airspeed(situation)
        return PathDemand(self._circle, self._altitude_m, airspeed_m_s=self._airspeed_m_s)

    def _choose_airspeed(self, situation: FlightSituation) -> None:
        state = situation.navigation
        assert state is not None
        away_m = distance_m(state.position, self._home.point)
        if away_m < ARRIVED_RADII * self._circle.radius_m:
            self._airspeed_m_s = None
            self._altitude_m = self._lowest_m
            self.successor = "LAND" if self.config.land else ""
        elif away_m > 2 * ARRIVED_RADII * self._circle.radius_m or self._airspeed_m_s is not None:
            course_deg = course_to_deg(state.position, self._home.point)
            self._airspeed_m_s = airspeed_for_wind_m_s(
                self._navigation, course_deg, state.wind_m_s, motor=True
            )
