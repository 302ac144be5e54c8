"""Runs Raspilot: ``python main.py [--config DIR]``."""

import sys
from pathlib import Path

from raspilot.main import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], Path(__file__).resolve().parent))
