"""QGroundControl's files ``.plan``: a mission, a fence and a home in one JSON document.

https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html
"""

import json
from collections.abc import Iterable
from typing import Any, TypeAlias

from up.commands.mission_commands import FENCE, MAX_ITEMS, MISSION
from up.fields import show
from up.mission.items import PLACED, Border, MissionItem
from up.mission.mavlink_items import FRAME_HOME, FileItem, read_items, write_items
from up.mission.plan import PLAN, Findings, Plan, Position, position

_FILE_VERSION, _MISSION_VERSION, _FENCE_VERSION = 1, 2, 2
_REPEATED = None
"""The key under which an object keeps the key that it had twice; keys of JSON are texts."""
_TRANSECTS = "TransectStyleComplexItem"
Fields: TypeAlias = dict[Any, Any]


def read_plan_file(text: str, found: Findings) -> Plan:
    """Return the contents of a file; problems go to ``found``."""
    try:
        given = json.loads(text, object_pairs_hook=_object)
    except (ValueError, RecursionError) as error:
        where = str(error)
        if isinstance(error, json.JSONDecodeError):
            where = f"{error.msg} in line {error.lineno}"
        found.problem(MISSION, 0, "not_json", f"the file is damaged or truncated: {where}")
        return Plan(PLAN)
    if not isinstance(given, dict) or given.get("fileType") != "Plan":
        found.problem(MISSION, 0, "not_a_plan", 'this is JSON, but its fileType is not "Plan"')
        return Plan(PLAN)
    _check_keys(given, found, MISSION, 0)
    _check_version(given, _FILE_VERSION, found, MISSION, "the file")
    mission = _part(given, "mission", found, MISSION)
    _check_version(mission, _MISSION_VERSION, found, MISSION, "the mission")
    items, numbers = read_items(_rows(_list(mission, "items", found, MISSION), found), found)
    fence = _part(given, "geoFence", found, FENCE)
    rally = given.get("rallyPoints")
    if isinstance(rally, dict) and rally.get("points"):
        found.note(MISSION, 0, "left_out", "the rally points are left out: RETURN flies home")
    if fence.get("breachReturn"):
        found.note(FENCE, 0, "left_out", "the breach return point is left out")
    cruise = mission.get("cruiseSpeed")
    return Plan(
        PLAN,
        items,
        _borders(fence, found),
        _home(mission.get("plannedHomePosition"), found),
        float(cruise) if isinstance(cruise, float | int) and 0 < cruise < 1000 else None,
        (),
        numbers,
    )


def write_plan_file(plan: Plan) -> str:
    """Return the text of a file."""
    items = []
    for row in write_items(plan.items):
        place = {
            "AMSLAltAboveTerrain": None,
            "Altitude": row.params[6],
            "AltitudeMode": 1 if row.frame == FRAME_HOME else 2,
        }
        items.append(
            {
                **(place if row.params[6] else {}),
                "autoContinue": True,
                "command": row.command,
                "doJumpId": row.jump_id,
                "frame": row.frame,
                "params": row.params,
                "type": "SimpleItem",
            }
        )
    fence: Fields = {"circles": [], "polygons": [], "version": _FENCE_VERSION}
    for border in plan.borders:
        common = {"inclusion": border.is_inside, "version": 1}
        if border.corners is not None:
            fence["polygons"].append({"polygon": border.corners, **common})
        else:
            center = [border.latitude_deg, border.longitude_deg]
            fence["circles"].append(
                {"circle": {"center": center, "radius": border.radius_m}, **common}
            )
    mission = {
        "cruiseSpeed": plan.cruise_m_s or 15,
        "firmwareType": 0,
        "hoverSpeed": 5,
        "items": items,
        "plannedHomePosition": plan.home or _first_place(plan.items),
        "vehicleType": 1,
        "version": _MISSION_VERSION,
    }
    document = {
        "fileType": "Plan",
        "geoFence": fence,
        "groundStation": "Up",
        "mission": mission,
        "rallyPoints": {"points": [], "version": 2},
        "version": _FILE_VERSION,
    }
    return json.dumps(document, indent=1, allow_nan=False) + "\n"


def _object(pairs: list[tuple[str, Any]]) -> Fields:
    fields: Fields = dict(pairs)
    if len(fields) != len(pairs):
        keys = [key for key, _ in pairs]
        fields[_REPEATED] = next(key for key in keys if keys.count(key) > 1)
    return fields


def _check_keys(given: Fields, found: Findings, plan: str, number: int) -> None:
    if _REPEATED in given:
        text = f"the key {show(given[_REPEATED])} is there twice"
        found.problem(plan, number, "key_repeated", text)


def _check_version(given: Fields, known: int, found: Findings, plan: str, what: str) -> None:
    version = given.get("version")
    if given and version != known:
        text = f"the version of {what} must be {known}, not {show(version)}"
        found.problem(plan, 0, "version", text)


def _part(given: Fields, key: str, found: Findings, plan: str) -> Fields:
    part = given.get(key)
    if isinstance(part, dict):
        _check_keys(part, found, plan, 0)
        return part
    if part is not None or plan == MISSION:
        found.problem(plan, 0, "incomplete", f"{key} must be an object, not {show(part)}")
    return {}


def _list(given: Fields, key: str, found: Findings, plan: str) -> list[Any]:
    part = given.get(key)
    if isinstance(part, list):
        return part
    if given:
        found.problem(plan, 0, "incomplete", f"{key} must be a list, not {show(part)}")
    return []


def _rows(items: list[Any], found: Findings) -> list[FileItem]:
    """Return the items of a file; those of a survey or a corridor stand in its place."""
    rows: list[FileItem] = []
    number = 0
    for each in items:
        inner: Any = [each]
        if isinstance(each, dict) and each.get("type") == "ComplexItem":
            transects = each.get(_TRANSECTS)
            inner = transects.get("Items") if isinstance(transects, dict) else None
            if not isinstance(inner, list) or not inner:
                number += 1
                text = f"{show(each.get('complexItemType'))} is a pattern without simple items"
                found.problem(MISSION, number, "pattern_unsupported", text)
                continue
        for given in inner:
            number += 1
            rows.append(_row(number, given if isinstance(given, dict) else {}, found))
    return rows


def _row(number: int, given: Fields, found: Findings) -> FileItem:
    _check_keys(given, found, MISSION, number)
    params = given.get("params")
    values = params if isinstance(params, list) else ()
    return FileItem(number, given.get("command"), given.get("frame"), values, given.get("doJumpId"))


def _borders(fence: Fields, found: Findings) -> tuple[Border, ...]:
    """Return the borders; they are numbered in this order: polygons, circles."""
    polygons, circles = (_list(fence, key, found, FENCE) for key in ("polygons", "circles"))
    given = [*polygons, *circles]
    if len(given) > MAX_ITEMS[FENCE]:
        text = f"a fence has at most {MAX_ITEMS[FENCE]} borders, and this has {len(given)}"
        found.problem(FENCE, MAX_ITEMS[FENCE] + 1, "too_many", text)
        return ()
    if given:
        _check_version(fence, _FENCE_VERSION, found, FENCE, "the fence")
    borders: list[Border] = []
    for number, each in enumerate(given, 1):
        border = each if isinstance(each, dict) else {}
        _check_keys(border, found, FENCE, number)
        fields = {"inside": border.get("inclusion"), "corners": border.get("polygon")}
        if number > len(polygons):
            fields = {"inside": border.get("inclusion"), **_circle(border.get("circle"))}
        try:
            borders.append(Border.from_data(fields))
        except ValueError as error:
            found.problem(FENCE, number, "item_invalid", str(error))
    return tuple(borders)


def _circle(given: Any) -> Fields:
    circle = given if isinstance(given, dict) else {}
    center = circle.get("center")
    latitude, longitude = center if isinstance(center, list) and len(center) == 2 else (None, None)
    return {"latitude": latitude, "longitude": longitude, "radius": circle.get("radius")}


def _home(given: object, found: Findings) -> Position | None:
    home = None if given is None else position(given)
    if home is None and given is not None:
        found.problem(MISSION, 0, "home", "plannedHomePosition is not a valid position")
    return home if home and any(home[:2]) else None


def _first_place(items: Iterable[MissionItem]) -> Position:
    for each in items:
        if each.kind in PLACED and each.latitude_deg is not None and each.longitude_deg is not None:
            return each.latitude_deg, each.longitude_deg, 0.0
    return 0.0, 0.0, 0.0
