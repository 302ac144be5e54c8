"""Whether the aircraft comes nearer to where it flies to."""

import math

from raspilot.navigation.planning import distance_m, flyable_radius_m, left_along_m
from up.flight_modes.demand import Circle, Line, PathDemand
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import NavigationState

STEP_M = 10.0
"""How much nearer counts: more than the position wanders in a minute."""
ARRIVED_RADII = 3.0


class ProgressWatch:
    """Remembers the least distance to the end of a path, and when it was reached."""

    def __init__(self, config: NavigationConfig) -> None:
        self._config = config
        self._path: object = None
        self._nearest_m = math.inf
        self._since_s = 0.0

    def stalled_s(self, now_s: float, demand: PathDemand | None, state: NavigationState) -> float:
        """Return for how long the distance has not become less; 0.0: the path ends nowhere."""
        path = None if demand is None else demand.path
        away_m = self._away_m(path, state)
        if path != self._path or away_m is None:
            self._path, self._nearest_m = path, math.inf
        if away_m is None:
            return 0.0
        if away_m < self._nearest_m - STEP_M:
            self._nearest_m, self._since_s = away_m, now_s
        return now_s - self._since_s

    def _away_m(self, path: object, state: NavigationState) -> float | None:
        """Return how far it is to the point of a line ahead, or to a circle; None: it is there."""
        if isinstance(path, Line):
            left_m = left_along_m(state.position, path.point, path.course_deg)
            return left_m if left_m > 0.0 else None
        if not isinstance(path, Circle):
            return None
        away_m = distance_m(state.position, path.centre)
        radius_m = flyable_radius_m(self._config, state, path.radius_m)
        return away_m if away_m > ARRIVED_RADII * radius_m else None
