"""GUIDED: flies to the target that the ground requested, and circles there."""

from raspilot.navigation.planning import circle_around, distance_m
from up.config import ConfigFile, key
from up.flight_modes.demand import Demand, PathDemand
from up.flight_modes.flight_mode import (
    FlightMode,
    FlightSituation,
    Home,
    ModeRefusal,
    Target,
)
from up.flight_modes.navigation_file import NAVIGATION
from up.flight_modes.navigation_state import NavigationState
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class GuidedConfig:
    """The mode GUIDED."""

    radius_m: float = key(
        50.0, "Radius of the circle without one in the target.", unit="m", minimum=15, maximum=500
    )
    max_distance_m: float = key(
        5000.0, "A target farther away is refused.", unit="m", minimum=100, maximum=50_000
    )
    max_climb_m: float = key(
        500.0, "A target farther above or below is refused.", unit="m", minimum=10, maximum=5000
    )


GUIDED = ConfigFile("guided.yml", GuidedConfig)


def altitude_refusal(
    altitude_m: float, state: NavigationState, home: Home | None, limit_m: float
) -> ModeRefusal | None:
    """Return why an altitude that the ground requires is not flown to; None: it is."""
    climb_m = altitude_m - state.altitude_m
    if not abs(climb_m) <= limit_m:
        side, code = ("above", "target_too_high") if climb_m > 0 else ("below", "target_too_low")
        return ModeRefusal(
            code,
            f"the target is {abs(climb_m):.0f} m {side} the aircraft, more than {limit_m:g} m"
            " (guided.yml: max_climb_m)",
        )
    if home is not None and altitude_m < home.altitude_m:
        below_m = home.altitude_m - altitude_m
        return ModeRefusal("target_below_home", f"the target is {below_m:.0f} m below home")
    return None


class Guided(FlightMode):
    """Flies to the target and circles there; a new target is followed if it is permitted."""

    NAME = "GUIDED"
    NEEDS = {"navigation": 3.0, "orientation": 1.0}
    FALLBACK = "LOITER"
    REQUESTS = frozenset({"target"})
    CONFIG = GUIDED

    def refusal(self, situation: FlightSituation) -> ModeRefusal | None:
        target, state, limits = situation.target, situation.navigation, self.config
        if target is None:
            return ModeRefusal("no_target", "no target; send up.navigation.target first")
        if state is None:
            return ModeRefusal("navigation", "the position is unknown")
        away_m = distance_m(state.position, target.point)
        if not away_m <= limits.max_distance_m:
            return ModeRefusal(
                "target_too_far",
                f"the target is {away_m / 1000:.1f} km away, more than"
                f" {limits.max_distance_m / 1000:g} km (guided.yml: max_distance_m)",
            )
        refusal = altitude_refusal(target.altitude_m, state, situation.home, limits.max_climb_m)
        if refusal is not None:
            return refusal
        if target.radius_m is not None and not target.radius_m > 0:
            text = f"the radius of the target is {target.radius_m:g} m; it must be above 0"
            return ModeRefusal("target_radius", text)
        return None

    def enter(self, situation: FlightSituation) -> None:
        self._requested: Target | None = None
        self._follow(situation)

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        if situation.target != self._requested and self.refusal(situation) is None:
            self._follow(situation)
        return self._demand

    def _follow(self, situation: FlightSituation) -> None:
        target, state = situation.target, situation.navigation
        assert target is not None
        assert state is not None
        radius_m = target.radius_m or self.config.radius_m
        navigation = self.context.config(NAVIGATION)
        self._requested = target
        circle = circle_around(navigation, state, target.point, radius_m)
        self._demand = PathDemand(circle, target.altitude_m)
