"""Mission items as MAVLink's commands: the form that both kinds of file share."""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from up.commands.mission_commands import MAX_ITEMS, MISSION
from up.fields import show
from up.mission.items import (
    HIGH,
    JUMP,
    LAND,
    LOITER,
    LOITER_TIME,
    LOITER_TURNS,
    PLACED,
    RETURN,
    SPEED,
    TAKEOFF,
    WAYPOINT,
    MissionItem,
)  # fmt: skip
from up.mission.mavlink_commands import NAMES, WITHOUT_EFFECT
from up.mission.plan import Findings
from up.quick_dataclass import dataclass

FRAME_SEA, FRAME_MISSION, FRAME_HOME = 0, 2, 3
_IS_ABOVE_SEA = {FRAME_SEA: True, FRAME_HOME: False, 5: True, 6: False}
_OVER_M = 10.0
"""A waypoint with an acceptance radius up to this is flown over."""
_OVER_WRITTEN_M = 1.0
_PARAMS = 7


@dataclass(frozen=True, slots=True)
class FileItem:
    """One row of a file, unchecked: ``number`` is its place, ``jump_id`` what jumps call it."""

    number: int
    command: Any
    frame: Any
    params: Sequence[Any]
    jump_id: Any


class _ItemError(ValueError):
    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.code = code


def read_items(
    rows: Sequence[FileItem], found: Findings
) -> tuple[tuple[MissionItem, ...], tuple[int, ...]]:
    """Return the items and their numbers in the file; problems and notes go to ``found``."""
    limit = MAX_ITEMS[MISSION]
    kept = [row for row in rows if not _is_left_out(row.command)]
    if len(kept) > limit:
        text = f"a mission has at most {limit} items, and this has {len(kept)}"
        found.problem(MISSION, kept[limit].number, "too_many", text)
        return (), ()
    targets = _targets(rows)
    items: list[MissionItem] = []
    for row in rows:
        try:
            if _is_left_out(row.command):
                text = f"{NAMES[row.command]} is left out: this aircraft has nothing that does it"
                found.note(MISSION, row.number, "left_out", text)
            else:
                items.append(_item(row, targets, len(kept)))
        except _ItemError as error:
            found.problem(MISSION, row.number, error.code, str(error))
        except ValueError as error:
            found.problem(MISSION, row.number, "item_invalid", str(error))
        if row.command == 16 and _is_above_zero(row, 0):
            text = "the hold time is left out: an aeroplane flies on; LOITER_TIME circles"
            found.note(MISSION, row.number, "hold", text)
    return tuple(items), tuple(row.number for row in kept)


def write_items(items: Iterable[MissionItem]) -> list[FileItem]:
    """Return one row for each item; fields that its kind does not use are not kept."""
    return [_row(number, item) for number, item in enumerate(items, 1)]


def _is_left_out(command: Any) -> bool:
    return type(command) is int and command in WITHOUT_EFFECT


def _targets(rows: Iterable[FileItem]) -> dict[Any, list[int]]:
    """Return what jumps may name, and the items there; one left out stands for the next."""
    targets: dict[Any, list[int]] = {}
    number = 1
    for row in rows:
        if isinstance(row.jump_id, int):
            targets.setdefault(row.jump_id, []).append(number)
        number += not _is_left_out(row.command)
    return targets


def _item(row: FileItem, targets: dict[Any, list[int]], count: int) -> MissionItem:
    if len(row.params) != _PARAMS:
        raise _ItemError("incomplete", f"its {_PARAMS} parameters are missing or incomplete")
    read = _READERS.get(row.command) if type(row.command) is int else None
    if read is None:
        name = NAMES.get(row.command) if type(row.command) is int else None
        if name is None:
            raise _ItemError("command_unknown", f"unknown command {show(row.command)}")
        raise _ItemError("command_unsupported", f"{name} ({row.command}) is not supported")
    kind, fields_of = read
    fields = {"kind": kind, **fields_of(row)}
    if kind == JUMP:
        fields["item"] = _target(fields["item"], targets, count)
    return MissionItem.from_data(fields)


def _target(named: Any, targets: dict[Any, list[int]], count: int) -> int:
    there = targets.get(named, [])
    if not there or there[0] > count:
        raise _ItemError("jump", f"jumps to item {show(named)}, which does not exist")
    if len(there) > 1:
        raise _ItemError("jump", f"jumps to item {show(named)}, and {len(there)} items have it")
    return there[0]


def _number(row: FileItem, parameter: int) -> int | float:
    """Return a parameter, counted from 0; null is 0."""
    given = row.params[parameter]
    if given is None:
        return 0.0
    if isinstance(given, bool) or not isinstance(given, int | float):
        text = f"parameter {parameter + 1} must be a number, not {show(given)}"
        raise _ItemError("item_invalid", text)
    return given


def _whole(row: FileItem, parameter: int) -> int | float:
    given = _number(row, parameter)
    return int(given) if isinstance(given, float) and given.is_integer() else given


def _is_above_zero(row: FileItem, parameter: int) -> bool:
    given = row.params[parameter] if parameter < len(row.params) else None
    return isinstance(given, int | float) and given > 0


def _height(row: FileItem) -> dict[str, Any]:
    frame = row.frame
    if type(frame) is not int or frame not in _IS_ABOVE_SEA:
        known = "0 or 5 (above sea level), 3 or 6 (above home)"
        raise _ItemError("frame", f"the frame must be {known}, not {show(frame)}")
    return {"altitude": row.params[6], "above_sea": _IS_ABOVE_SEA[frame]}


def _place(row: FileItem) -> dict[str, Any]:
    latitude, longitude = row.params[4:6]
    if latitude == longitude == 0:
        raise _ItemError("no_position", "the position 0, 0 stands for none; give one")
    return {"latitude": latitude, "longitude": longitude, **_height(row)}


def _waypoint(row: FileItem) -> dict[str, Any]:
    is_over = 0 < _number(row, 1) <= _OVER_M or _number(row, 2) > 0
    return {**_place(row), "over": is_over}


def _circle(parameter: int) -> Callable[[FileItem], dict[str, Any]]:
    """Return a reader of the circle whose radius is that parameter: 0 is the usual one."""

    def read(row: FileItem) -> dict[str, Any]:
        radius = _number(row, parameter)
        is_clockwise = radius > 0 or (radius == 0 and math.copysign(1, radius) > 0)
        return {**_place(row), "radius": abs(radius) or None, "clockwise": is_clockwise}

    return read


def _turns(row: FileItem) -> dict[str, Any]:
    return {**_circle(2)(row), "turns": _number(row, 0)}


def _time(row: FileItem) -> dict[str, Any]:
    return {**_circle(2)(row), "time": _number(row, 0)}


def _speed(row: FileItem) -> dict[str, Any]:
    if _number(row, 0) != 0:
        raise _ItemError("value", "only the airspeed can be set: parameter 1 must be 0")
    if _number(row, 2) not in (-1, 0):
        raise _ItemError("value", "the throttle cannot be set: parameter 3 must be -1")
    return {"airspeed": row.params[1]}


def _jump(row: FileItem) -> dict[str, Any]:
    return {"item": _whole(row, 0), "repeat": _whole(row, 1)}


_READERS: dict[int, tuple[str, Callable[[FileItem], dict[str, Any]]]] = {
    16: (WAYPOINT, _waypoint),
    17: (LOITER, _circle(2)),
    18: (LOITER_TURNS, _turns),
    19: (LOITER_TIME, _time),
    20: (RETURN, lambda row: {}),
    21: (LAND, _place),
    22: (TAKEOFF, _height),
    # It circles until the altitude is reached, as a loiter of no time does.
    31: (LOITER_TIME, _circle(1)),
    177: (JUMP, _jump),
    178: (SPEED, _speed),
}


def _row(number: int, item: MissionItem) -> FileItem:
    radius = math.copysign(item.radius_m or 0.0, 1.0 if item.is_clockwise else -1.0)
    forms: dict[str, tuple[Any, ...]] = {
        WAYPOINT: (16, 0.0, _OVER_WRITTEN_M * item.is_over),
        LOITER: (17, 0.0, 0.0, radius),
        LOITER_TURNS: (18, item.turns, 0.0, radius),
        LOITER_TIME: (19, item.time_s, 0.0, radius) if item.time_s else (31, 0.0, radius),
        RETURN: (20,),
        LAND: (21,),
        TAKEOFF: (22,),
        JUMP: (177, item.item, item.repeat),
        SPEED: (178, 0.0, item.airspeed_m_s, -1.0),
    }
    command, *params = forms[item.kind]
    params += [0.0] * (_PARAMS - len(params))
    frame = FRAME_MISSION
    if item.kind in PLACED:
        params[4:6] = [item.latitude_deg, item.longitude_deg]
    if item.kind in HIGH:
        params[6] = item.altitude_m
        frame = FRAME_SEA if item.is_above_sea else FRAME_HOME
    return FileItem(number, command, frame, params, number)
