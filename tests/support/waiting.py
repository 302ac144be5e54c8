"""Waiting for a condition of another process."""

import time

DEADLINE_S = 30.0


def until(condition, what, deadline_s=DEADLINE_S):
    """Return the first true value of a condition; fail after a generous time."""
    end_s = time.monotonic() + deadline_s
    while not (value := condition()):
        assert time.monotonic() < end_s, f"never came: {what}"
        time.sleep(0.01)
    return value
