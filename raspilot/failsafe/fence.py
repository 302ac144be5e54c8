"""Whether the aircraft is about to cross the fence."""

from __future__ import annotations

from raspilot.failsafe.config import Fence
from raspilot.navigation.planning import distance_m
from up.flight_modes.flight_mode import Home
from up.flight_modes.navigation_state import NavigationState, Point

AHEAD_S = 4.0
"""The flight that is looked ahead: so much the turn away from a border needs in a tail wind."""


class FenceWatch:
    """Compares the estimate with the fence; its standard deviation counts as outside."""

    def __init__(self, fence: Fence) -> None:
        self._fence = fence
        self._was_above_floor = False

    def is_crossed(self, state: NavigationState | None, home: Home | None) -> bool:
        """Return whether a border is crossed, or will be in AHEAD_S; False where nothing is known.

        Without an estimate or home there is no border: the modes' own fallbacks act.
        """
        if state is None or home is None:
            return False
        fence = self._fence
        north_m, east_m = state.position
        north_m_s, east_m_s = state.velocity_m_s
        ahead = Point(north_m + AHEAD_S * north_m_s, east_m + AHEAD_S * east_m_s)
        away_m = max(distance_m(each, home.point) for each in (state.position, ahead))
        height_m = state.altitude_m - home.altitude_m
        change_m = AHEAD_S * state.climb_m_s
        above_m = height_m + max(0.0, change_m) + state.altitude_sd_m
        below_m = height_m + min(0.0, change_m) - state.altitude_sd_m
        if fence.floor_m is not None and below_m > fence.floor_m:
            self._was_above_floor = True
        return (
            (fence.radius_m is not None and away_m + state.position_sd_m > fence.radius_m)
            or (fence.ceiling_m is not None and above_m > fence.ceiling_m)
            or (fence.floor_m is not None and self._was_above_floor and below_m < fence.floor_m)
        )
