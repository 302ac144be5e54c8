"""``up log view``."""

from __future__ import annotations

from typing import Any

from up.cli.option_parser import whole_number
from up.cli.verb import add_verb

_EPILOG = """\
FLIGHT is the number of a flight, 'last', a file of a flight, or a folder that
holds the parts of one. A second flight is drawn over the first one.

The first look at a flight reads its whole log; the columns that it makes are
kept in the cache folder (~/.cache/raspilot/columns), so the next is immediate.

examples
  up log view last
  up log view 12 11
"""


def add(verbs: Any) -> None:
    """Add the verb below `up log`."""
    from up_flightlog.cli.parser import add_folder_options

    text = "look at a flight, or at two, in a page: zoom, spectrum, map"
    parser = add_verb(verbs, "view", "up_ground.view.view", text, epilog=_EPILOG)
    parser.add_argument("flight", metavar="FLIGHT", help="see below")
    parser.add_argument("other", metavar="OTHER", nargs="?", help="a flight to compare with")
    parser.add_argument(
        "--port",
        type=whole_number(0, 65535),
        default=0,
        help="port on the loopback interface (default: a free one)",
    )
    add_folder_options(parser)
