"""The options by which a verb of ``up log`` is told where flights are."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

PLACE = "flights_place"
"""What whoever makes ``up log`` leaves among the parsed values for the verbs of others: a
``Place``, which knows the application's black_box.yml."""

Place = Callable[[argparse.Namespace], Path]
"""Returns the folder that parsed options mean."""


def take_folder(parser: argparse.ArgumentParser) -> None:
    """Add the options that say where flights are."""
    parser.add_argument(
        "--folder",
        type=Path,
        metavar="DIR",
        help="where the flights are (default: as black_box.yml says)",
    )
    parser.add_argument(
        "--config", type=Path, metavar="DIR", help="folder with black_box.yml (default: config)"
    )
