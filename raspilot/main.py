"""The command line of Raspilot."""

from collections.abc import Sequence
from pathlib import Path

from up.cli.option_parser import OptionParser, add_defaults_option
from up.cli.parser import add_config_option
from up.program import run_application
from up.version import VERSION


def main(arguments: Sequence[str], start: Path) -> int:
    """Run Raspilot from the folder ``start``; return the exit status."""
    parser = OptionParser(
        prog="main.py",
        description="Runs Raspilot, the autopilot: reads the Arduino and the phone, connects"
        " to the ground. Ctrl-C stops it.",
        epilog="The mode comes from config.yml or the environment variable UP_MODE (auto, flight"
        " controller, black box). 'up check' finds configuration mistakes without starting,"
        " 'up modules' lists the loaded modules.",
    )
    add_config_option(parser)
    add_defaults_option(parser)
    parser.add_argument("--version", action="version", version=f"Raspilot {VERSION}")
    values = parser.parse_args(arguments)
    return run_application(start, values.config, use_defaults=values.defaults)
