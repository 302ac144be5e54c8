"""What a mission and a fence consist of."""

import hashlib
import json
from collections.abc import Iterable
from typing import TypeAlias

from up.commands.command import WireFields, value
from up.commands.mission_commands import FENCE, MAX_ITEMS, MISSION
from up.quick_dataclass import dataclass

MAX_CORNERS = 100

TAKEOFF, WAYPOINT, LOITER, LOITER_TURNS, LOITER_TIME, RETURN, LAND, SPEED, JUMP = KINDS = (
    "takeoff", "waypoint", "loiter", "loiter_turns", "loiter_time", "return", "land", "speed",
    "jump",
)  # fmt: skip
PLACED = frozenset({WAYPOINT, LOITER, LOITER_TURNS, LOITER_TIME, LAND})
"""Kinds that need a position."""
HIGH = PLACED | {TAKEOFF}
"""Kinds that need an altitude."""


@dataclass(frozen=True, slots=True)
class MissionItem(WireFields):
    """One item of a mission.

    ``altitude_m`` is above home, or above sea level if ``is_above_sea``. ``waypoint`` is passed on
    the inside of the turn, or over the point if ``is_over``. ``loiter`` never ends;
    ``loiter_turns`` and ``loiter_time`` do. ``radius_m`` None: that of LOITER. ``speed`` sets the
    airspeed of the items after it. ``jump`` goes to item ``item`` (the first is 1), ``repeat``
    times, -1 is without end. ``return`` flies home and circles there.
    """

    kind: str = value(choices=KINDS)
    latitude_deg: float | None = value(None, key="latitude", minimum=-90, maximum=90, unit="deg")
    longitude_deg: float | None = value(
        None, key="longitude", minimum=-180, maximum=180, unit="deg"
    )
    altitude_m: float | None = value(None, key="altitude", minimum=-1000, maximum=9000, unit="m")
    is_above_sea: bool = value(False, key="above_sea")
    is_over: bool = value(False, key="over")
    radius_m: float | None = value(None, key="radius", minimum=10, maximum=1000, unit="m")
    is_clockwise: bool = value(True, key="clockwise")
    turns: float = value(1.0, minimum=0.1, maximum=1000)
    time_s: float = value(0.0, key="time", minimum=0, maximum=86400, unit="s")
    airspeed_m_s: float | None = value(None, key="airspeed", minimum=3, maximum=60, unit="m/s")
    item: int | None = value(None, minimum=1, maximum=MAX_ITEMS[MISSION])
    repeat: int = value(1, minimum=-1, maximum=1000)

    def __post_init__(self) -> None:
        if self.kind in PLACED and (self.latitude_deg is None or self.longitude_deg is None):
            raise ValueError(f"latitude and longitude are missing: {self.kind} needs them")
        if self.kind in HIGH and self.altitude_m is None:
            raise ValueError(f"altitude is missing: {self.kind} needs it")
        if self.kind == SPEED and self.airspeed_m_s is None:
            raise ValueError("airspeed is missing: speed needs it")
        if self.kind == JUMP and self.item is None:
            raise ValueError("item is missing: jump needs it")


@dataclass(frozen=True, slots=True)
class Border(WireFields):
    """One border of a fence: a circle, or a polygon of at least three corners.

    ``corners`` are pairs of latitude and longitude (deg). The aircraft stays inside at least one of
    the borders with ``is_inside``, if there are any, and outside all others.
    """

    is_inside: bool = value(True, key="inside")
    corners: tuple[tuple[float, float], ...] | None = value(None, max_length=MAX_CORNERS)
    latitude_deg: float | None = value(None, key="latitude", minimum=-90, maximum=90, unit="deg")
    longitude_deg: float | None = value(
        None, key="longitude", minimum=-180, maximum=180, unit="deg"
    )
    radius_m: float | None = value(None, key="radius", minimum=30, maximum=100_000, unit="m")

    def __post_init__(self) -> None:
        circle = (self.latitude_deg, self.longitude_deg, self.radius_m)
        if self.corners is None:
            if None in circle:
                raise ValueError("latitude, longitude and radius, or corners, are missing")
            return
        if any(each is not None for each in circle):
            raise ValueError("corners and a circle exclude each other")
        if len(self.corners) < 3:
            raise ValueError(f"corners must be at least 3, not {len(self.corners)}")
        object.__setattr__(self, "corners", tuple(_corner(each) for each in self.corners))


PlanItem: TypeAlias = MissionItem | Border
ITEM_CLASSES: dict[str, type[MissionItem] | type[Border]] = {MISSION: MissionItem, FENCE: Border}


def plan_id(items: Iterable[PlanItem]) -> str:
    """Return the identity of a mission or a fence: 16 hexadecimal digits; "" without items."""
    data = [each.data for each in items]
    if not data:
        return ""
    text = json.dumps(data, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _corner(given: object) -> tuple[float, float]:
    if isinstance(given, list | tuple) and len(given) == 2:
        latitude, longitude = given
        if _is_number(latitude, 90) and _is_number(longitude, 180):
            return float(latitude), float(longitude)
    raise ValueError("corners must be pairs of a latitude and a longitude")


def _is_number(given: object, limit: float) -> bool:
    return (
        isinstance(given, int | float) and not isinstance(given, bool) and -limit <= given <= limit
    )
