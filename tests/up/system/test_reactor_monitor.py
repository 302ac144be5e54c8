"""Calls that block the reactor are named; in another process, since the alarm is per process.

A thread that was there before the monitor (those of a parallel test runner, say) could take the
alarm away from it; a daemon has none.
"""

import subprocess
import sys
from pathlib import Path

from tests.support.waiting import HANG_S

ROOT = Path(__file__).parents[3]


def test_the_cases_pass_in_a_process_with_one_thread():
    result = subprocess.run(
        [
            *(sys.executable, "-m", "pytest", "-q", "-p", "no:xdist", "-p", "no:cacheprovider"),
            "tests/up/system/reactor_monitor_cases.py",
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=HANG_S,
        check=False,
    )
    assert result.returncode == 0, result.stdout + result.stderr
    assert "15 passed" in result.stdout
