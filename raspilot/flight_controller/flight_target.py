"""Where the active mode flies to: for telemetry, for a restart, and as the ground requires."""

from collections.abc import Mapping

from raspilot.flight_controller.flight_memory import FlightMemory
from raspilot.flight_controller.home import place_of_target
from raspilot.flight_modes.guided import altitude_refusal
from up.commands.refusal import CommandRefusedError
from up.flight_modes.demand import Circle, PathDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation, Target
from up.flight_modes.navigation_state import NavigationState
from up.flight_modes.selector import REFUSED

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


def check_required(
    what: str,
    value: float,
    acting: str | None,
    modes: Mapping[str, FlightMode],
    situation: FlightSituation | None,
    max_climb_m: float,
) -> None:
    """Raise CommandRefusedError unless the acting mode can follow a requirement of the ground.

    ``what`` is ``course`` (``value`` in deg) or ``altitude`` (m above sea level).
    """
    if acting is None or acting not in modes or what not in modes[acting].REQUESTS:
        able = [name for name, each in modes.items() if what in each.REQUESTS]
        raise CommandRefusedError(
            f"a required {what} acts in {' and '.join(able) or 'no flight mode'} only",
            detail=REFUSED,
        )
    if what != "altitude" or situation is None or situation.navigation is None:
        return
    refusal = altitude_refusal(value, situation.navigation, situation.home, max_climb_m)
    if refusal is not None:
        raise CommandRefusedError(refusal.text, detail=refusal.code)
