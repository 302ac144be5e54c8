"""``up-ground mission``: its options."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from up.cli.option_parser import add_json_option, whole_number
from up.cli.verb import add_verb
from up.commands.mission_commands import FENCE, MAX_ITEMS, MISSION, PLANS

_EPILOG = """\
FILE is a plan of QGroundControl (.plan: mission and fence) or a file of
waypoints (QGC WPL 110, of Mission Planner or MAVProxy: mission only).

The first flight of a mission
  up-ground mission check field.plan     offline: every problem, with its item
  up-ground mission upload field.plan    the aircraft checks it as a whole, with
                                         its home, fence, wind, airspeeds, and
                                         uses all of it or nothing; then it is
                                         read back and compared
  up-ground mission status               the plans in use, and the next item
  up-ground mission start                continues at that item; take off first,
                                         unless the first item is a takeoff
  up-ground mission start --item 1       begins again

A file without borders leaves the fence of the aircraft unchanged, one without
items its mission. Of a file with both the fence is uploaded first; if the
mission is refused then, the fence that was in use before is restored.

exit status
  0 done; 1 problems in the file, or refused by the aircraft, which keeps
  that plan as it was; 2 error in the command line; 3 no connection, no
  aircraft or no answer
"""


def add_mission(verbs: Any) -> None:
    """Add the verb with its actions."""
    text = "check, upload, download, start or clear a mission and a fence"
    mission = add_verb(verbs, "mission", "up_ground.mission:run", text, epilog=_EPILOG)
    actions = mission.add_subparsers(dest="action", metavar="ACTION", required=True)
    check = actions.add_parser("check", help="report all problems of a file, offline")
    upload = actions.add_parser("upload", help="upload a file, and read it back")
    download = actions.add_parser("download", help="write the plans in use to a new file")
    for action in (check, upload, download):
        action.add_argument("file", type=Path, metavar="FILE", help="a .plan or .waypoints file")
    for action in (upload, download):
        only = action.add_mutually_exclusive_group()
        for plan in PLANS:
            only.add_argument(
                f"--{plan}-only", action="store_const", const=(plan,), dest="plans",
                default=(FENCE, MISSION), help=f"only the {plan}",
            )  # fmt: skip
    start = actions.add_parser("start", help="select the flight mode MISSION")
    start.add_argument(
        "--item",
        type=whole_number(1, MAX_ITEMS[MISSION]),
        metavar="N",
        help="begin at this item; the first is 1",
    )
    status = actions.add_parser("status", help="show the plans in use and the next item")
    clear = actions.add_parser("clear", help="remove the mission or the fence of the aircraft")
    clear.add_argument("plans", choices=PLANS, type=str, metavar="mission|fence")
    for action in (check, upload, download, status):
        add_json_option(action)
    for name, action in actions.choices.items():
        action.set_defaults(parser=action, action=name)
