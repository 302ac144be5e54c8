"""Waiting for a condition of another process."""

import time
from pathlib import Path

DEADLINE_S = 90.0
HANG_S = 800.0
"""A program that a test started hangs if it runs for longer; a test may take 900 s."""


def until(condition, what, deadline_s=DEADLINE_S):
    """Return the first true value of a condition; fail after a generous time.

    `what` names the condition, or is called for the reason of the failure: the text of a log.
    """
    end_s = time.monotonic() + deadline_s
    while not (value := condition()):
        if time.monotonic() > end_s:
            raise AssertionError(f"never came: {what() if callable(what) else what}")
        time.sleep(0.01)
    return value


def is_running(pid):
    """Return whether a process has not ended; a zombie has."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False
