"""``up gather``."""

from __future__ import annotations

import argparse

from up.cli.locate import application_of
from up.cogs.gather import gather


def run(values: argparse.Namespace) -> int:
    """Install and register the cogs of the Cogfile."""
    gather(application_of(values), may_install=not values.no_install)
    return 0
