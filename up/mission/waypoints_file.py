"""Waypoint files: the text ``QGC WPL 110`` of Mission Planner, MAVProxy and QGroundControl.

A row has twelve columns: index, current, frame, command, parameters 1 to 7, autocontinue. The
first row is home. A line that begins with # is a comment.
"""

import math
import re
from typing import Any

from up.commands.mission_commands import FENCE, MISSION
from up.mission.mavlink_items import FRAME_SEA, FileItem, read_items, write_items
from up.mission.plan import WAYPOINTS, Findings, Plan, PlanError, PlanProblem, Position, position

HEADER = "QGC WPL"
_VERSION = "110"
_COLUMNS = 12
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?|[+-]?(nan|inf)", re.A | re.I)
_LONGEST = 40
"""Characters of a number."""


def read_waypoints(text: str, found: Findings) -> Plan:
    """Return the mission of a file; problems go to ``found``."""
    header, *lines = text.splitlines()
    if header.split()[2:] != [_VERSION]:
        found.problem(MISSION, 0, "version", f"the first line must be {HEADER} {_VERSION}")
        return Plan(WAYPOINTS)
    rows: list[FileItem] = []
    for line in lines:
        if line.strip() and not line.lstrip().startswith("#"):
            row = [_value(word) for word in line.split()]
            # A row with a column too many or too few has no parameters that can be trusted.
            params = row[4:11] if len(row) == _COLUMNS else ()
            row += [None] * _COLUMNS
            rows.append(FileItem(len(rows), row[3], row[2], params, row[0]))
    if not rows:
        found.problem(MISSION, 0, "no_home", "the row of home, the first one, is missing")
        return Plan(WAYPOINTS)
    items, numbers = read_items(rows[1:], found)
    return Plan(WAYPOINTS, items, (), _home(rows[0], found), None, (), numbers)


def write_waypoints(plan: Plan) -> str:
    """Return the text of a file; raises PlanError for a plan with a fence."""
    if plan.borders:
        text = "a file of waypoints has no place for a fence; use the form plan"
        raise PlanError("", [PlanProblem(FENCE, 0, "no_fence", text)])
    home = FileItem(0, 16, FRAME_SEA, (0.0,) * 4 + (plan.home or (0.0,) * 3), 0)
    lines = [f"{HEADER} {_VERSION}"]
    for row in [home, *write_items(plan.items)]:
        is_home = int(row is home)
        cells = [row.number, is_home, row.frame, row.command, *row.params, 1]
        lines.append("\t".join(map(repr, cells)))
    return "\n".join(lines) + "\n"


def _value(word: str) -> Any:
    """Return the number of a cell, whole where it can be; the text if it is not a number."""
    if len(word) > _LONGEST or not _NUMBER.fullmatch(word):
        return word
    number = float(word)
    is_index = math.isfinite(number) and number.is_integer() and "." not in word
    return int(number) if is_index else number


def _home(row: FileItem, found: Findings) -> Position | None:
    home = position(row.params[4:])
    if home is None:
        found.problem(MISSION, 0, "home", "home, the first row, has no valid position")
    return home if home and any(home[:2]) else None
