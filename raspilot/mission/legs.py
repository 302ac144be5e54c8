"""The legs of a mission: straight lines between items, and the turns from one to the next."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import field

from raspilot.mission.progress import LAST, NOT_FLOWN, airspeed_of, following
from raspilot.navigation.planning import (
    course_to_deg,
    distance_m,
    ground_speed_m_s,
    turn_radius_m,
)
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import LocalFrame, Point
from up.mission.items import (
    JUMP,
    LOITER,
    LOITER_TIME,
    LOITER_TURNS,
    RETURN,
    TAKEOFF,
    WAYPOINT,
    MissionItem,
)
from up.quick_dataclass import dataclass

CIRCLED = frozenset({LOITER, LOITER_TURNS, LOITER_TIME})
MAX_LEAD_DEG = 120.0
"""A sharper turn begins no earlier."""


def turn_between_deg(course_deg: float, next_deg: float) -> float:
    """Return the angle between two courses, 0 to 180 degrees."""
    return abs((next_deg - course_deg + 180.0) % 360.0 - 180.0)


def lead_m(radius_m: float, turn_deg: float) -> float:
    """Return how far before a corner the turn inside it begins."""
    return radius_m * math.tan(math.radians(min(turn_deg, MAX_LEAD_DEG) / 2))


def ahead(point: Point, course_deg: float, way_m: float) -> Point:
    """Return the point that is ``way_m`` farther along a course."""
    course = math.radians(course_deg)
    return Point(point.north_m + way_m * math.cos(course), point.east_m + way_m * math.sin(course))


@dataclass(frozen=True, slots=True)
class Leg:
    """The way from one item to another, in the wind; ``ground_m_s`` None: it cannot be flown."""

    start: int
    end: int
    a: Point
    b: Point
    airspeed_m_s: float
    ground_m_s: float | None
    length_m: float = field(init=False)
    course_deg: float = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "length_m", distance_m(self.a, self.b))
        object.__setattr__(self, "course_deg", course_to_deg(self.a, self.b))


class Course:
    """The items of a mission as points, in a frame whose origin is home if that is known."""

    def __init__(
        self,
        items: Sequence[MissionItem],
        home: tuple[float, float] | None,
        navigation: NavigationConfig,
        wind: Point,
        loiter_radius_m: float,
    ) -> None:
        self.items = items
        self.navigation = navigation
        self.wind = wind
        fastest_m_s = navigation.airspeed.cruise_m_s + math.hypot(*wind)
        self._least_m = turn_radius_m(navigation, fastest_m_s)
        self._loiter_radius_m = loiter_radius_m
        self._is_home_known = home is not None
        places = ((each.latitude_deg, each.longitude_deg) for each in items)
        placed = ((north, east) for north, east in places if north is not None and east is not None)
        self.frame = LocalFrame(*(home or next(placed, (0.0, 0.0))))
        self.reached = set(self._reached())

    def point(self, number: int) -> Point | None:
        """Return where an item is; None if that is not known, as home is not."""
        item = self.items[number - 1]
        if item.latitude_deg is not None and item.longitude_deg is not None:
            return self.frame.point(item.latitude_deg, item.longitude_deg)
        is_home = self._is_home_known and item.kind in {RETURN, TAKEOFF}
        return Point(0.0, 0.0) if is_home else None

    def radius_m(self, number: int) -> float:
        return max(self._least_m, self.items[number - 1].radius_m or self._loiter_radius_m)

    def legs(self) -> Iterator[Leg]:
        """Yield every leg that may be flown, but those to the first item."""
        for start in sorted(self.reached):
            if self.items[start - 1].kind in LAST:
                continue
            for end in following(self.items, start + 1):
                leg = None if end > len(self.items) else self._leg(start, end)
                if leg is not None:
                    yield leg

    def may_end_at(self, number: int) -> bool:
        """Return whether the mission may end after an item, and circles there."""
        if self.items[number - 1].kind in LAST:
            return False
        return len(self.items) + 1 in following(self.items, number + 1)

    def lead_m(self, before: Leg, after: Leg) -> float:
        """Return how much of both legs the turn between them needs."""
        fastest_m_s = max(before.airspeed_m_s, after.airspeed_m_s) + math.hypot(*self.wind)
        radius_m = turn_radius_m(self.navigation, fastest_m_s)
        turn_deg = turn_between_deg(before.course_deg, after.course_deg)
        item = self.items[before.end - 1]
        if item.kind != WAYPOINT:
            return 0.0
        if item.is_over:
            return 2.0 * radius_m * math.sin(math.radians(turn_deg / 2))
        return lead_m(radius_m, turn_deg)

    def _leg(self, start: int, end: int) -> Leg | None:
        a, b = self.point(start), self.point(end)
        if a is None or b is None:
            return None
        item = self.items[start - 1]
        radius_m, away_m = self.radius_m(start), distance_m(a, b)
        if item.kind in CIRCLED and away_m > radius_m:
            # It leaves the circle along the tangent to the next item.
            side_deg = math.degrees(math.acos(radius_m / away_m))
            turned_deg = -side_deg if item.is_clockwise else side_deg
            a = ahead(a, course_to_deg(a, b) + turned_deg, radius_m)
        airspeed = airspeed_of(self.items, end) or self.navigation.airspeed.cruise_m_s
        ground = ground_speed_m_s(airspeed, course_to_deg(a, b), self.wind)
        return Leg(start, end, a, b, airspeed, ground)

    def _reached(self) -> Iterator[int]:
        waiting, seen = list(following(self.items, 1)), set[int]()
        while waiting:
            number = waiting.pop()
            if number in seen or number > len(self.items):
                continue
            seen.add(number)
            yield number
            if self.items[number - 1].kind not in LAST:
                waiting.extend(following(self.items, number + 1))


def has_loop_without_place(items: Sequence[MissionItem], number: int) -> bool:
    """Return whether a jump can come back to itself without anything to fly in between."""
    waiting, seen = [items[number - 1].item or 0], set[int]()
    while waiting:
        at = waiting.pop()
        if at == number:
            return True
        if at in seen or not 0 < at <= len(items) or items[at - 1].kind not in NOT_FLOWN:
            continue
        seen.add(at)
        waiting += [at + 1, (items[at - 1].item or 0) if items[at - 1].kind == JUMP else 0]
    return False
