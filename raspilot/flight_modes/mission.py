"""MISSION: flies the items of the mission in use, one after the other."""

from dataclasses import replace
from typing import Any

from raspilot.flight_modes.loiter import LOITER as LOITER_FILE
from raspilot.mission.borders import LocalBorders, crosses, local_borders
from raspilot.mission.flight import CircleFlight, ClimbFlight, ItemFlight, LineFlight
from raspilot.mission.progress import MissionProgress, airspeed_of
from raspilot.modules.plans import Plans
from raspilot.navigation.planning import circle_abeam, circle_around, flyable_radius_m
from up.flight_modes.demand import AttitudeDemand, Circle, Demand
from up.flight_modes.flight_mode import (
    FlightMode,
    FlightSituation,
    Home,
    ModeRefusal,
    Target,
)
from up.flight_modes.navigation_file import NAVIGATION
from up.flight_modes.navigation_state import LocalFrame, Point
from up.flight_modes.selector import DemandError
from up.mission.items import LAND, LOITER_TIME, LOITER_TURNS, RETURN, TAKEOFF, WAYPOINT, MissionItem
from up.mode import WITH_BOARD
from up.needs import needs

SAVE_S = 5.0
"""Progress of a circle is saved this often: a restart loses no more."""


class Mission(FlightMode):
    """Flies to the item that is next, from wherever the aircraft is; circles at the end.

    ``takeoff``, ``land`` and ``return`` are flown by the modes of these names, which replace this
    one: their own rules for failures hold. TAKEOFF comes back to it.
    """

    NAME = "MISSION"
    MODES = WITH_BOARD
    NEEDS = {"navigation": 3.0, "orientation": 1.0}
    FALLBACK = "LOITER"

    plans = needs(Plans)

    continues = False
    _goal: Target | None = None

    def on_init(self) -> None:
        self._modes = {each.NAME: each for each in self.up.get_modules(FlightMode)}
        self._borders: tuple[object, LocalBorders] = (None, ())

    @property
    def goal(self) -> Target | None:
        return self._goal

    def refusal(self, situation: FlightSituation) -> ModeRefusal | None:
        state, problems = situation.navigation, self.plans.problems
        if not self.plans.missions.items:
            return ModeRefusal("no_mission", "there is no mission; upload one")
        if situation.home is None:
            return ModeRefusal("no_home", "no home is set; send up.home.set")
        if state is None:
            return ModeRefusal("navigation", "the position is unknown")
        if problems is None:
            return ModeRefusal("mission_invalid", "the mission is not checked yet")
        if problems:
            first = problems[0]
            return ModeRefusal("mission_invalid", f"item {first.item}: {first.text}")
        item = self._items[self.plans.progress.item - 1]
        if item.kind == TAKEOFF and not state.is_in_flight:
            refusal = self._modes["TAKEOFF"].refusal(situation)
            return ModeRefusal("mode_refused", refusal) if isinstance(refusal, str) else refusal
        end = self._point(self.plans.progress, state.frame, situation.home)
        if end is not None and crosses(self._fence(state.frame), state.position, end):
            text = "the way to the next item is outside the fence"
            return ModeRefusal("mission_invalid", text)
        return None

    def enter(self, situation: FlightSituation) -> None:
        self._flown: MissionProgress | None = None
        self._flight: ItemFlight | None = None
        self._goal, self.successor, self.continues = None, "", False

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        state, items = situation.navigation, self._items
        assert state is not None
        if not items:
            raise DemandError("the mission was removed", "no_mission")
        if self._flown is not self.plans.progress:
            self._begin(self.plans.progress, situation)
        flight, flown = self._flight, self._flown
        assert flight is not None
        assert flown is not None
        if not flown.is_finished and flight.is_done(state, dt_s):
            self._begin(flown.next(items), situation)
        elif isinstance(flight, CircleFlight):
            self._save(flight, flown)
        assert self._flight is not None
        if self.continues:
            # In the hand, until TAKEOFF replaces this mode.
            return AttitudeDemand(0.0, 0.0, 0.0)
        return self._flight.demand(state)

    @property
    def _items(self) -> Any:
        return self.plans.missions.items

    def _save(self, flight: CircleFlight, flown: MissionProgress) -> None:
        if flight.waited_s >= flown.waited_s + SAVE_S:
            turned_deg = max(0.0, flight.turned_deg)
            self._flown = replace(flown, turned_deg=turned_deg, waited_s=flight.waited_s)
            self.plans.progress = self._flown

    def _begin(self, progress: MissionProgress, situation: FlightSituation) -> None:
        self._flown = self.plans.progress = progress
        self._goal, self.successor, self.continues = None, "", False
        if progress.is_finished:
            self._flight = self._circle(progress, situation)
        else:
            self._flight = self._flight_of(progress, situation)

    def _flight_of(self, progress: MissionProgress, situation: FlightSituation) -> ItemFlight:
        state, home = situation.navigation, situation.home
        assert state is not None
        item: MissionItem = self._items[progress.item - 1]
        point, altitude_m = self._point(progress, state.frame, home), _altitude_m(item, home)
        airspeed_m_s = airspeed_of(self._items, progress.item)
        after = progress.next(self._items)
        following = None if after.is_finished else self._point(after, state.frame, home)
        if item.kind == TAKEOFF and state.is_in_flight:
            return ClimbFlight(state, altitude_m)
        if item.kind in {TAKEOFF, LAND, RETURN}:
            self.successor, self.continues = item.kind.upper(), item.kind == TAKEOFF
            if item.kind != RETURN and point is not None:
                self._goal = Target(point, altitude_m, item.radius_m)
        if item.kind == WAYPOINT:
            assert point is not None
            start = None
            if progress.start:
                before = replace(progress, item=progress.start)
                start = self._point(before, state.frame, home)
            config = self.context.config(NAVIGATION)
            return LineFlight(
                config, start or state.position, state.altitude_m, point, altitude_m,
                airspeed_m_s, following, is_over=item.is_over,
            )  # fmt: skip
        return self._circle(progress, situation, following)

    def _circle(
        self, progress: MissionProgress, situation: FlightSituation, following: Point | None = None
    ) -> CircleFlight:
        state, home = situation.navigation, situation.home
        assert state is not None
        config, item = self.context.config(NAVIGATION), self._items[progress.item - 1]
        radius_m = item.radius_m or self.context.config(LOITER_FILE).radius_m
        point = self._point(progress, state.frame, home)
        if point is None or item.kind == TAKEOFF:
            circle = circle_abeam(config, state, radius_m)
        elif item.kind in {WAYPOINT, LAND, RETURN}:
            circle = circle_around(config, state, point, radius_m)
        else:
            radius_m = flyable_radius_m(config, state, radius_m)
            circle = Circle(point, radius_m, item.is_clockwise)
        # Until a mode that replaces this one no longer refuses.
        altitude_m = state.altitude_m if self.successor else _altitude_m(item, home)
        flight = CircleFlight(
            circle,
            altitude_m,
            airspeed_of(self._items, progress.item),
            turns=item.turns if item.kind == LOITER_TURNS else None,
            time_s=item.time_s if item.kind == LOITER_TIME else None,
            following=following,
        )
        flight.turned_deg, flight.waited_s = progress.turned_deg, progress.waited_s
        return flight

    def _point(
        self, progress: MissionProgress, frame: LocalFrame, home: Home | None
    ) -> Point | None:
        item: MissionItem = self._items[progress.item - 1]
        if item.latitude_deg is not None and item.longitude_deg is not None:
            return frame.point(item.latitude_deg, item.longitude_deg)
        return home.point if home is not None and item.kind in {RETURN, TAKEOFF} else None

    def _fence(self, frame: LocalFrame) -> LocalBorders:
        fences = self.plans.fences
        key = (fences.plan_id, frame)
        if key != self._borders[0]:
            borders: Any = fences.items
            self._borders = (key, local_borders(borders, frame))
        return self._borders[1]


def _altitude_m(item: MissionItem, home: Home | None) -> float:
    """Return an item's altitude above sea level; 0.0 for one without."""
    assert home is not None
    above_m = item.altitude_m or 0.0
    return above_m if item.is_above_sea else home.altitude_m + above_m
