"""``up-ground replay``, and the same as ``up log replay``."""

from __future__ import annotations

import argparse
from typing import Any

from up.cli.verb import add_verb
from up_ground.page_options import add_page_options

_EPILOG = """\
FLIGHT is the number of a flight, 'last', a file of a flight (its later parts
are taken along; or several files, the parts of one), or a folder that holds the
parts of one. The page shows it as the ground station shows an aircraft, with a
bar to play, pause, go to a moment and play faster or slower. It takes no
Commands.

examples
  up-ground replay last
  up-ground replay run/flights/receiver-lost/flight.mcap --listen 127.0.0.1:8081
"""


def add(verbs: Any) -> None:
    """Add ``up log replay``, which finds flights as the other verbs of ``up log`` do."""
    from up_flightlog.cli.parser import add_folder_options

    add_folder_options(_add(verbs))


def add_replay(verbs: Any) -> None:
    """Add ``up-ground replay``, which has no application."""
    _add(verbs).add_argument(
        "--folder", metavar="DIR", help="where the black box's flights are (default: its usual one)"
    )


def _add(verbs: Any) -> argparse.ArgumentParser:
    text = "play a recorded flight in the page of the ground station"
    parser = add_verb(verbs, "replay", "up_ground.replay.replay", text, epilog=_EPILOG)
    parser.add_argument("flight", nargs="+", metavar="FLIGHT", help="see below")
    add_page_options(parser)
    return parser
