"""Whether the aircraft is about to cross the fence."""

import math

from raspilot.failsafe.config import Fence
from raspilot.mission.borders import LocalBorders, crosses, local_borders, margin_m
from raspilot.navigation.planning import distance_m
from up.flight_modes.flight_mode import Home
from up.flight_modes.navigation_state import LocalFrame, NavigationState, Point
from up.mission.items import Border

AHEAD_S = 4.0
"""The flight that is looked ahead: so much the turn away from a border needs in a tail wind."""


class FenceWatch:
    """Compares the estimate with the fence; its standard deviation counts as outside.

    ``margin_m`` is the distance to the nearest border over the ground, negative outside; None: no
    border, or the position is unknown.
    """

    def __init__(self, fence: Fence) -> None:
        self._fence = fence
        self._was_above_floor = False
        self._plan: tuple[Border, ...] = ()
        self._frame: LocalFrame | None = None
        self._borders: LocalBorders = ()
        self.margin_m: float | None = None

    def use(self, plan: tuple[Border, ...]) -> None:
        """Watch the borders of this plan from now on, beside those of failsafe.yml."""
        if plan is not self._plan:
            self._plan, self._frame = plan, None

    def is_crossed(self, state: NavigationState | None, home: Home | None) -> bool:
        """Return whether a border is crossed, or will be in AHEAD_S; False where nothing is known.

        Without an estimate there is no border, and without home none of failsafe.yml: the modes'
        own fallbacks act.
        """
        self.margin_m = None
        if state is None:
            return False
        if state.frame != self._frame:
            self._frame, self._borders = state.frame, local_borders(self._plan, state.frame)
        north_m, east_m = state.position
        north_m_s, east_m_s = state.velocity_m_s
        ahead = Point(north_m + AHEAD_S * north_m_s, east_m + AHEAD_S * east_m_s)
        margins_m = [self._margin_m(each, home) for each in (state.position, ahead)]
        self.margin_m = margins_m[0] if math.isfinite(margins_m[0]) else None
        is_at_height = home is None or not self._leaves_heights(state, home)
        return (
            not is_at_height
            or min(margins_m) < state.position_sd_m
            or crosses(self._borders, state.position, ahead)
        )

    def is_outside(self, point: Point, home: Home | None) -> bool:
        """Return whether a point of the newest estimate's frame is outside a border."""
        return self._margin_m(point, home) < 0.0

    def _margin_m(self, point: Point, home: Home | None) -> float:
        within_m = margin_m(self._borders, point)
        if home is None or self._fence.radius_m is None:
            return within_m
        return min(within_m, self._fence.radius_m - distance_m(point, home.point))

    def _leaves_heights(self, state: NavigationState, home: Home) -> bool:
        fence = self._fence
        height_m = state.altitude_m - home.altitude_m
        change_m = AHEAD_S * state.climb_m_s
        above_m = height_m + max(0.0, change_m) + state.altitude_sd_m
        below_m = height_m + min(0.0, change_m) - state.altitude_sd_m
        if fence.floor_m is not None and below_m > fence.floor_m:
            self._was_above_floor = True
        return (fence.ceiling_m is not None and above_m > fence.ceiling_m) or (
            fence.floor_m is not None and self._was_above_floor and below_m < fence.floor_m
        )
