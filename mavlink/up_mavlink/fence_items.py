"""Borders of a fence as items of MAVLink's mission type fence."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from up.commands.mission_commands import FENCE
from up.mission.items import Border
from up.mission.mavlink_items import FileItem
from up.mission.plan import Findings

RETURN_POINT, INSIDE_POLYGON, OUTSIDE_POLYGON, INSIDE_CIRCLE, OUTSIDE_CIRCLE = range(5000, 5005)
_POLYGONS, _CIRCLES = (INSIDE_POLYGON, OUTSIDE_POLYGON), (INSIDE_CIRCLE, OUTSIDE_CIRCLE)
FRAME = 0


def read_borders(rows: Sequence[FileItem], found: Findings) -> tuple[Border, ...]:
    """Return the borders; problems and notes, with the number of the item, go to ``found``."""
    borders: list[Border] = []
    corners: list[tuple[float, float]] = []
    begun: FileItem | None = None
    for row in rows:
        count = 0 if begun is None else int(begun.params[0] or 0)
        if begun is not None and (row.command != begun.command or row.params[0] != count):
            _problem(found, row, f"the polygon has {len(corners)} of its {count} corners")
            return ()
        if row.command in _POLYGONS:
            begun = begun or row
            corners.append((row.params[4], row.params[5]))
            if len(corners) >= int(row.params[0] or 0):
                data = {"inside": row.command == INSIDE_POLYGON, "corners": corners}
                _add(borders, data, row, found)
                begun, corners = None, []
        elif row.command in _CIRCLES:
            latitude, longitude = row.params[4:6]
            data = {"inside": row.command == INSIDE_CIRCLE, "radius": row.params[0]}
            _add(borders, {**data, "latitude": latitude, "longitude": longitude}, row, found)
        elif row.command == RETURN_POINT:
            text = "the return point of the fence is left out: RETURN flies home"
            found.note(FENCE, row.number, "left_out", text)
        else:
            _problem(found, row, f"command {row.command} is not part of a fence")
    if begun is not None:
        _problem(found, begun, "the polygon has not all of its corners")
    return tuple(borders)


def write_borders(borders: Iterable[Border]) -> list[FileItem]:
    """Return the items of a fence."""
    rows: list[FileItem] = []
    for border in borders:
        places = border.corners or ((border.latitude_deg, border.longitude_deg),)
        kinds = _POLYGONS if border.corners else _CIRCLES
        first = float(len(places)) if border.corners else border.radius_m
        for latitude, longitude in places:
            params = (first, 0.0, 0.0, 0.0, latitude, longitude, 0.0)
            number = len(rows)
            rows.append(FileItem(number, kinds[not border.is_inside], FRAME, params, number))
    return rows


def _add(borders: list[Border], data: dict[str, object], row: FileItem, found: Findings) -> None:
    try:
        borders.append(Border.from_data(data))
    except ValueError as error:
        _problem(found, row, str(error))


def _problem(found: Findings, row: FileItem, text: str) -> None:
    found.problem(FENCE, row.number, "item_invalid", text)
