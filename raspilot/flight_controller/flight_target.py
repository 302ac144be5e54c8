"""Where the active mode flies to, for telemetry and for a restart."""

from raspilot.flight_controller.flight_memory import FlightMemory
from raspilot.flight_controller.home import place_of_target
from up.flight_modes.demand import Circle, PathDemand
from up.flight_modes.flight_mode import Target
from up.flight_modes.navigation_state import NavigationState

ALTITUDE_STEP_M = 1.0
"""A smaller change of the altitude is not saved: it may change in every step."""


class FlightTarget:
    """Saves the goal of a mode, or the circle that it demands, when it changes."""

    def __init__(self, memory: FlightMemory) -> None:
        self._memory = memory
        self._saved: Target | None = None

    def forget(self) -> None:
        """Begin a mode: the next demand is saved whatever it is."""
        self._saved = None

    def follow(
        self,
        demand: PathDemand,
        goal: Target | None,
        navigation: NavigationState,
        *,
        is_fallback: bool,
    ) -> None:
        """Take the demand of a step, and the goal of its mode.

        A fallback that flies no circle leaves the one to which the selected mode comes back.
        """
        saved, path = self._saved, demand.path
        if goal is None and isinstance(path, Circle):
            altitude_m = demand.altitude_m
            if altitude_m is None:
                altitude_m = navigation.altitude_m if saved is None else saved.altitude_m
            goal = Target(path.centre, altitude_m, path.radius_m)
        if goal is None:
            if saved is not None and not is_fallback:
                self._saved = None
                self._memory.update(target=None)
        elif saved is None or not _is_near(goal, saved):
            self._saved = goal
            self._memory.update(target=place_of_target(goal, navigation.frame))


def _is_near(goal: Target, saved: Target) -> bool:
    is_place_same = (goal.point, goal.radius_m) == (saved.point, saved.radius_m)
    return is_place_same and abs(goal.altitude_m - saved.altitude_m) < ALTITUDE_STEP_M
