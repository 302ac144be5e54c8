"""A signal for a child process when its parent ends, even by ``kill -9``."""

import ctypes
import os
import signal
import sys
from collections.abc import Callable

_PR_SET_PDEATHSIG = 1
"""Source: prctl(2)."""


def request_death_signal(
    number: int = signal.SIGTERM, parent: int | None = None
) -> Callable[[], None] | None:
    """Return a function that the child calls, before exec or in a fork, to get a signal then.

    ``parent`` is the process that creates it, by default this one. None: only Linux supports it.
    """
    if not sys.platform.startswith("linux"):
        return None
    prctl = ctypes.CDLL(None).prctl
    expected_parent = os.getpid() if parent is None else parent

    def request() -> None:
        prctl(_PR_SET_PDEATHSIG, number, 0, 0, 0)
        # A parent that died before this request sends no signal.
        if os.getppid() != expected_parent:
            os.kill(os.getpid(), number)

    return request
