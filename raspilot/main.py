"""The command line of Raspilot."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from up.program import run_application
from up.version import VERSION


def main(arguments: Sequence[str], start: Path) -> int:
    """Run Raspilot from the folder ``start``; return the exit status."""
    parser = argparse.ArgumentParser(
        prog="main.py",
        description="Runs Raspilot, the autopilot: reads the Arduino and the phone, talks to the"
        " ground. Stop it with Ctrl-C.",
        epilog="The mode comes from config.yml or the environment variable UP_MODE (auto, flight"
        " controller, black box). 'up check' finds mistakes in the configuration without starting,"
        " 'up modules' shows what would be loaded.",
    )
    parser.add_argument(
        "--config", type=Path, metavar="DIR", help="folder with the YAML files (default: config)"
    )
    parser.add_argument(
        "--defaults", action="store_true", help="start with the defaults where no file is found"
    )
    parser.add_argument("--version", action="version", version=f"Raspilot {VERSION}")
    values = parser.parse_args(arguments)
    return run_application(start, values.config, use_defaults=values.defaults)
