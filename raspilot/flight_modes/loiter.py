"""LOITER: circles where it was entered."""

from raspilot.navigation.planning import circle_abeam, circle_around
from up.config import ConfigFile, key
from up.flight_modes.demand import Demand, PathDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation
from up.flight_modes.navigation_file import NAVIGATION
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class LoiterConfig:
    """The mode LOITER."""

    radius_m: float = key(
        50.0, "Radius; more where the wind requires it.", unit="m", minimum=15, maximum=500
    )


LOITER = ConfigFile("loiter.yml", LoiterConfig)


class Loiter(FlightMode):
    """Circles through where it was entered, to the side of the bank; holds the altitude.

    After a restart of the program it circles where it did before.
    """

    NAME = "LOITER"
    NEEDS = {"navigation": 3.0, "orientation": 1.0}
    FALLBACK = "CIRCLE"
    REQUESTS = frozenset({"altitude"})
    CONFIG = LOITER

    def enter(self, situation: FlightSituation) -> None:
        state = situation.navigation
        assert state is not None
        navigation = self.context.config(NAVIGATION)
        target = situation.target
        if target is None:
            self._circle = circle_abeam(navigation, state, self.config.radius_m)
            self._altitude_m = state.altitude_m
        else:
            radius_m = target.radius_m or self.config.radius_m
            self._circle = circle_around(navigation, state, target.point, radius_m)
            self._altitude_m = target.altitude_m

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        if situation.required_altitude_m is not None:
            self._altitude_m = situation.required_altitude_m
        return PathDemand(self._circle, self._altitude_m)
