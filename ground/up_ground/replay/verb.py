"""``up-ground replay``, and the same as ``up log replay``."""

from __future__ import annotations

import argparse
from typing import Any

from up_ground.page_options import add_page_options

EPILOG = """\
FLIGHT is a file of the black box (its other parts are taken along), a folder with flights (the
newest), the number of a flight, or 'last'. The page shows it as the ground station shows an
aircraft, with a bar to play, pause, go to a moment and play faster or slower. It takes no Commands.

examples
  up-ground replay last
  up-ground replay run/flights/receiver-lost/flight.mcap --listen 127.0.0.1:8081
"""


def add(verbs: Any) -> None:
    """Add ``up log replay``."""
    from up.cli.verb import add_verb

    text = "play a flight in the page of the ground station"
    add_arguments(add_verb(verbs, "replay", "up_ground.replay.replay", text, epilog=EPILOG))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the verb takes."""
    parser.add_argument("flight", nargs="+", metavar="FLIGHT", help="see below")
    parser.add_argument(
        "--folder", metavar="DIR", help="where the black box's flights are (default: its usual one)"
    )
    add_page_options(parser)
