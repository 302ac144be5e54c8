"""Runs Raspilot: ``python -m raspilot [--config DIR]``."""

import sys
from pathlib import Path

from up.cli.entry import start

if __name__ == "__main__":
    sys.exit(start("raspilot.main", sys.argv[1:], Path(__file__).resolve().parent))
