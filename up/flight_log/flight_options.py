"""The options of the ``up log`` verbs that select the folder of flights."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

PLACE = "flights_place"
"""The parsed value in which ``up log`` stores a ``Place`` for the verbs of others; it knows the
application's black_box.yml."""

Place = Callable[[argparse.Namespace], Path]
"""Returns the folder that the parsed options select."""


def add_folder_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that select the folder of flights."""
    parser.add_argument(
        "--folder",
        type=Path,
        metavar="DIR",
        help="folder of the flights (default: from black_box.yml)",
    )
    parser.add_argument(
        "--config", type=Path, metavar="DIR", help="folder with black_box.yml (default: config)"
    )
