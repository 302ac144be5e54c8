"""Whether a mission or a fence can be flown as a whole."""

import math
from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from dataclasses import field, replace
from itertools import islice

from raspilot.failsafe.config import Fence
from raspilot.failsafe.fence import AHEAD_S
from raspilot.mission.borders import LocalBorders, crosses, local_borders, margin_m
from raspilot.mission.config import MissionConfig
from raspilot.mission.legs import CIRCLED, Course, Leg, ahead, has_loop_without_place
from raspilot.mission.progress import NOT_FLOWN
from raspilot.mission.store import Problem
from raspilot.navigation.airframe_model import AirframeModel
from up.commands.mission_commands import FENCE, MAX_ITEMS, MISSION
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import LocalFrame, Point
from up.mission.items import JUMP, LAND, RETURN, SPEED, TAKEOFF, WAYPOINT, Border, MissionItem
from up.quick_dataclass import dataclass

MIN_GROUND_M_S, MIN_LEG_M = 2.0, 10.0
SD_M, HEIGHT_MARGIN_M = 5.0, 10.0
"""The fence acts so much before a border: deviation of the estimate, and the end of a climb."""
CIRCLE_CORNERS = 16
MAX_LEGS = 2000
CALM = Point(0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Circumstances:
    """What a plan is checked against. ``home`` is latitude, longitude (deg), altitude (m)."""

    limits: MissionConfig = field(default_factory=MissionConfig)
    navigation: NavigationConfig = field(default_factory=NavigationConfig)
    fence: Fence = field(default_factory=Fence)
    borders: Sequence[Border] = ()
    home: tuple[float, float, float] | None = None
    wind: Point = CALM
    loiter_radius_m: float = 50.0
    return_radius_m: float = 50.0
    modes: Collection[str] = ("TAKEOFF", "LAND", "RETURN")


def check_mission(items: Sequence[MissionItem], given: Circumstances) -> list[Problem]:
    """Return the problems of a mission, by item; none: it can be flown."""
    if len(items) > MAX_ITEMS[MISSION]:
        return [Problem(0, "too_many", f"more than {MAX_ITEMS[MISSION]} items")]
    found = sorted(_listed(items, given))
    if not any(each.code in {"jump", "no_items"} for each in found):
        found += _Check(items, given).problems()
    return sorted(set(found))


def check_fence(
    borders: Sequence[Border], items: Sequence[MissionItem], given: Circumstances
) -> list[Problem]:
    """Return the problems of a fence, beside the mission in use."""
    if len(borders) > MAX_ITEMS[FENCE]:
        return [Problem(0, "too_many", f"more than {MAX_ITEMS[FENCE]} borders")]
    given = replace(given, borders=borders)
    problems = [
        Problem(number, "crosses_itself", "its edges cross: give its corners in order")
        for number, each in enumerate(borders, 1)
        if each.corners and local_borders([each], LocalFrame(*each.corners[0]))[0].crosses_itself
    ]
    if problems:
        return problems
    if given.home is not None:
        frame = LocalFrame(*given.home[:2])
        if margin_m(local_borders(borders, frame), Point(0.0, 0.0)) < SD_M:
            return [Problem(0, "home_outside", "home is outside the fence, or on its border")]
    for problem in check_mission(items, given) if items else ():
        if problem.code == "fence":
            text = f"item {problem.item} of the mission in use: {problem.text}"
            return [Problem(0, "home_outside", text)]
    return []


def _listed(items: Sequence[MissionItem], given: Circumstances) -> Iterator[Problem]:
    """Yield the problems of the list, whatever the places of its items are."""
    flown = [number for number, each in enumerate(items, 1) if each.kind not in NOT_FLOWN]
    if not flown:
        yield Problem(0, "no_items", "the mission has nothing to fly")
        return
    speeds = given.navigation.airspeed
    for number, item in enumerate(items, 1):
        if item.kind == JUMP:
            assert item.item is not None
            if item.item > len(items):
                yield Problem(number, "jump", f"there is no item {item.item}")
            elif has_loop_without_place(items, number):
                yield Problem(number, "jump", "the loop has no item to fly")
        elif item.kind == SPEED:
            assert item.airspeed_m_s is not None
            if not speeds.minimum_m_s <= item.airspeed_m_s <= speeds.maximum_m_s:
                text = f"{speeds.minimum_m_s:g} to {speeds.maximum_m_s:g} m/s (navigation.yml)"
                yield Problem(number, "airspeed", f"the airspeed must be {text}")
        elif item.kind == TAKEOFF and number != flown[0]:
            yield Problem(number, "item_invalid", "takeoff must be the first item")
        mode = item.kind.upper()
        if item.kind in {TAKEOFF, LAND, RETURN} and mode not in given.modes:
            yield Problem(number, "mode_unknown", f"the flight mode {mode} is not loaded")


class _Check:
    """Checks the places of a mission and the legs between them."""

    def __init__(self, items: Sequence[MissionItem], given: Circumstances) -> None:
        self._items, self._given = items, given
        home = given.home
        self._course = Course(
            items, home and home[:2], given.navigation, given.wind, given.loiter_radius_m
        )
        self._borders: LocalBorders = local_borders(given.borders, self._course.frame)
        self._legs = list(islice(self._course.legs(), MAX_LEGS + 1))
        self._to: defaultdict[int, list[Leg]] = defaultdict(list)
        self._from: defaultdict[int, list[Leg]] = defaultdict(list)
        for leg in self._legs:
            self._to[leg.end].append(leg)
            self._from[leg.start].append(leg)

    def problems(self) -> Iterator[Problem]:
        reached = self._course.reached
        if len(self._legs) > MAX_LEGS:
            yield Problem(0, "too_many", "the jumps permit too many ways")
            return
        for number, item in enumerate(self._items, 1):
            if number in reached:
                yield from self._heights(number, item)
                yield from self._place(number, item)
            elif item.kind not in NOT_FLOWN:
                yield Problem(number, "after_end", "the mission ends before this item")
        for leg in self._legs:
            yield from self._leg(leg)

    def _height_m(self, number: int) -> float | None:
        """Return the height above home; None if that is not known."""
        item, home = self._items[number - 1], self._given.home
        if item.altitude_m is None or not item.is_above_sea:
            return item.altitude_m
        return None if home is None else item.altitude_m - home[2]

    def _heights(self, number: int, item: MissionItem) -> Iterator[Problem]:
        height_m = self._height_m(number)
        limits, fence = self._given.limits, self._given.fence
        if height_m is None:
            return
        if height_m > limits.max_height_m:
            text = f"{height_m:.0f} m above home, more than {limits.max_height_m:g} m"
            yield Problem(number, "too_high", f"{text} (mission.yml: max_height_m)")
        if fence.ceiling_m is not None and height_m + HEIGHT_MARGIN_M > fence.ceiling_m:
            text = f"less than {HEIGHT_MARGIN_M:g} m below the ceiling of failsafe.yml"
            yield Problem(number, "fence", text)
        if item.kind == LAND:
            return
        if height_m < limits.min_height_m:
            text = f"{height_m:.0f} m above home, less than {limits.min_height_m:g} m"
            yield Problem(number, "too_low", f"{text} (mission.yml: min_height_m)")
        if fence.floor_m is not None and height_m - HEIGHT_MARGIN_M < fence.floor_m:
            text = f"less than {HEIGHT_MARGIN_M:g} m above the floor of failsafe.yml"
            yield Problem(number, "fence", text)

    def _place(self, number: int, item: MissionItem) -> Iterator[Problem]:
        point = self._course.point(number)
        if point is None:
            return
        radius_m = 0.0
        if item.kind in CIRCLED or item.kind == LAND or self._course.may_end_at(number):
            radius_m = self._course.radius_m(number)
        elif item.kind == RETURN:
            radius_m = self._given.return_radius_m
        away_m = math.hypot(*point) + radius_m
        limit_m = self._given.limits.max_distance_m
        if self._given.home is not None and away_m > limit_m:
            text = f"{away_m:.0f} m from home, more than {limit_m:g} m"
            yield Problem(number, "too_far", f"{text} (mission.yml: max_distance_m)")
        if radius_m:
            # The fence looks ahead along the tangent.
            speed_m_s = self._given.navigation.airspeed.cruise_m_s + math.hypot(*self._given.wind)
            radius_m = math.hypot(radius_m, AHEAD_S * speed_m_s)
        turns = (360.0 * each / CIRCLE_CORNERS for each in range(CIRCLE_CORNERS))
        places = [ahead(point, turn, radius_m) for turn in turns] if radius_m else [point]
        if any(self._is_outside(each) for each in places):
            text = "its circle is outside the fence, or too near its border"
            if not radius_m:
                text = "outside the fence, or too near its border"
            yield Problem(number, "fence", text)

    def _is_outside(self, point: Point) -> bool:
        fence, home = self._given.fence, self._given.home
        is_far = fence.radius_m is not None and math.hypot(*point) + SD_M > fence.radius_m
        return (is_far and home is not None) or margin_m(self._borders, point) < SD_M

    def _leg(self, leg: Leg) -> Iterator[Problem]:
        number = leg.end
        if leg.ground_m_s is None or leg.ground_m_s < MIN_GROUND_M_S:
            wind_m_s = math.hypot(*self._given.wind)
            text = f"{leg.airspeed_m_s:g} m/s of airspeed against {wind_m_s:.0f} m/s of wind"
            yield Problem(number, "wind", f"from item {leg.start}: {text}")
            return
        before = [self._course.lead_m(each, leg) for each in self._to[leg.start]]
        after = [self._course.lead_m(leg, each) for each in self._from[number]]
        lead_m = max(after, default=0.0)
        turns_m = max(before, default=0.0) + lead_m
        if self._items[number - 1].kind == WAYPOINT:
            turns_m = max(MIN_LEG_M, turns_m)
        if leg.length_m < turns_m:
            text = f"the leg from item {leg.start} has {leg.length_m:.0f} m"
            yield Problem(number, "turn", f"{text}, its turns need {turns_m:.0f} m")
        yield from self._climb(leg, leg.ground_m_s)
        end = leg.b
        if self._items[number - 1].kind == WAYPOINT and not self._course.may_end_at(number):
            is_over = self._items[number - 1].is_over
            beyond_m = AHEAD_S * leg.ground_m_s - (0.0 if is_over else lead_m)
            end = ahead(leg.b, leg.course_deg, max(0.0, beyond_m))
        crossed = self._borders and crosses(self._borders, leg.a, end)
        if crossed or self._is_outside(end):
            text = f"the leg from item {leg.start} comes too near the fence or crosses it"
            yield Problem(number, "fence", text)

    def _climb(self, leg: Leg, ground_m_s: float) -> Iterator[Problem]:
        start_m, end_m = self._height_m(leg.start), self._height_m(leg.end)
        if start_m is None or end_m is None or self._items[leg.end - 1].kind != WAYPOINT:
            return
        vertical = self._given.navigation.vertical
        glide_m_s = AirframeModel(self._given.navigation).sink_m_s(leg.airspeed_m_s, 1.0)
        sink_m_s = min(vertical.sink_limit_m_s, glide_m_s)
        limit_m_s = vertical.climb_limit_m_s if end_m > start_m else sink_m_s
        needed_m = abs(end_m - start_m) / limit_m_s * ground_m_s
        if needed_m > leg.length_m:
            way = "climb" if end_m > start_m else "descent"
            text = f"the leg from item {leg.start} has {leg.length_m:.0f} m"
            yield Problem(leg.end, "climb", f"{text}, its {way} needs {needed_m:.0f} m")
