"""Plans as the rows of MAVLink's mission protocol; uploaded rows are kept unchanged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from up.commands.mission_commands import FENCE, MISSION
from up.mission.items import JUMP, MissionItem, PlanItem, plan_id
from up.mission.mavlink_items import FRAME_SEA, FileItem, read_items, write_items
from up.mission.plan import Findings, Position
from up_mavlink.fence_items import read_borders, write_borders
from up_mavlink.personas import Persona

TYPES = {0: MISSION, 1: FENCE}
WAYPOINT, DO_JUMP, DO_CHANGE_SPEED = 16, 177, 178
GROUND_SPEED = 1


@dataclass(frozen=True, slots=True)
class Rows:
    """A plan with its rows; ``numbers`` are the sequence numbers of its items in the rows."""

    plan: str
    items: tuple[PlanItem, ...]
    rows: tuple[FileItem, ...]
    numbers: tuple[int, ...]

    @property
    def plan_id(self) -> str:
        return plan_id(self.items)

    def item_of(self, sequence: int) -> int:
        """Return the first item that a row with this number, or one after it, has become."""
        found = (place for place, each in enumerate(self.numbers, 1) if each >= sequence)
        return next(found, len(self.numbers) + 1)


def read_rows(plan: str, rows: Sequence[FileItem], persona: Persona, found: Findings) -> Rows:
    """Return an uploaded plan; problems and notes go to ``found``, with the rows' numbers."""
    if plan == FENCE:
        borders = read_borders(rows, found)
        return Rows(plan, borders, tuple(rows), tuple(range(len(borders))))
    first = int(bool(rows) and persona.has_home_item and _is_home(rows[0]))
    flown = [_with_airspeed(row, found) for row in rows[first:]]
    items, numbers = read_items(flown, found)
    return Rows(plan, items, tuple(rows), numbers)


def write_rows(
    plan: str, items: Sequence[PlanItem], persona: Persona, home: Position | None
) -> Rows:
    """Return the rows of a plan that did not come from this endpoint."""
    if plan == FENCE:
        borders = write_borders(items)  # type: ignore[arg-type]
        return Rows(plan, tuple(items), tuple(borders), tuple(range(len(items))))
    flown: list[MissionItem] = list(items)  # type: ignore[arg-type]
    first = int(persona.has_home_item)
    rows = [] if not first or not flown else [_home_row(home)]
    for item, row in zip(flown, write_items(flown), strict=True):
        params = list(row.params)
        if item.kind == JUMP and item.item is not None:
            params[0] = float(item.item - 1 + first)
        rows.append(replace(row, number=len(rows), params=params))
    numbers = tuple(range(first, first + len(flown)))
    return Rows(plan, tuple(items), tuple(rows), numbers)


def _is_home(row: FileItem) -> bool:
    """Return whether the first row is home, as ground stations of ArduPilot send it."""
    return row.command == WAYPOINT and row.frame == FRAME_SEA and not any(row.params[:4])


def _home_row(home: Position | None) -> FileItem:
    latitude, longitude, altitude = home or (0.0, 0.0, 0.0)
    params = (0.0, 0.0, 0.0, 0.0, latitude, longitude, altitude)
    return FileItem(0, WAYPOINT, FRAME_SEA, params, 0)


def _with_airspeed(row: FileItem, found: Findings) -> FileItem:
    """Return a row whose speed is an airspeed: ground stations ask for speed over the ground."""
    if row.command != DO_CHANGE_SPEED or row.params[0] != GROUND_SPEED:
        return row
    text = "the speed over the ground is flown as airspeed"
    found.note(MISSION, row.number, "ground_speed", text)
    return replace(row, params=[0.0, *row.params[1:]])
