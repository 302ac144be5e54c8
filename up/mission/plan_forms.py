"""Files of ground stations, whatever their form."""

import dataclasses

from up.commands.mission_commands import MISSION
from up.mission.plan import FORMS, PLAN, Findings, Plan, PlanError
from up.mission.plan_file import read_plan_file, write_plan_file
from up.mission.waypoints_file import HEADER, read_waypoints, write_waypoints

MAX_CHARACTERS = 1 << 24


def read_plan(text: str, name: str) -> Plan:
    """Return the contents of a file of either form.

    Raises PlanError with all its problems; ``name`` is the file's, for their texts.
    """
    found = Findings()
    plan = Plan(PLAN)
    # Windows begins files with a byte order mark.
    content = text.removeprefix("\ufeff").lstrip()
    if len(text) > MAX_CHARACTERS:
        found.problem(MISSION, 0, "too_long", f"a file has at most {MAX_CHARACTERS} characters")
    elif content.startswith(HEADER):
        plan = read_waypoints(content, found)
    elif content.startswith(("{", "[")):
        plan = read_plan_file(content, found)
    else:
        forms = "a QGroundControl plan (JSON) nor waypoints (QGC WPL 110)"
        found.problem(MISSION, 0, "not_a_plan", f"the file is neither {forms}")
    if found.problems:
        raise PlanError(name, found.problems)
    return dataclasses.replace(plan, notes=tuple(found.notes))


def write_plan(plan: Plan) -> str:
    """Return the text of a file of the plan's form; raises PlanError for what it cannot hold."""
    if plan.form not in FORMS:
        raise ValueError(f"unknown form {plan.form!r}")
    return write_plan_file(plan) if plan.form == PLAN else write_waypoints(plan)
