"""Runs Raspilot with Python's own garbage collector in place of the quiet one: the control run.

The same program otherwise; for the benchmark only.
"""

import sys
from pathlib import Path

from raspilot.main import main
from up import program
from up.system.gc_scheduler import GcScheduler


class DefaultCollector(GcScheduler):
    """Uses Python's defaults: nothing is frozen, the automatic collector stays on."""

    def start(self) -> None:
        """Do nothing."""


if __name__ == "__main__":
    program.GcScheduler = DefaultCollector  # type: ignore[attr-defined]
    sys.exit(main(sys.argv[1:], Path(__file__).resolve().parents[1]))
