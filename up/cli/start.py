"""``up start``."""

from __future__ import annotations

import argparse

from up.cli.locate import application_of
from up.program import run_application


def run(values: argparse.Namespace) -> int:
    """Run the application until it is stopped."""
    return run_application(application_of(values).root, values.config, use_defaults=values.defaults)
