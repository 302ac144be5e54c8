"""The result of a module's start (thesis 4.1.3)."""

from __future__ import annotations

from enum import Enum


class StartResult(Enum):
    """How the boot continues after a module's start."""

    STARTED = "started"
    FAILED_GO_ON = "failed, go on"
    FAILED_STOP = "failed, stop"


class StartFailedError(Exception):
    """Raised by a start that failed for a reason that a user can fix; the text is one sentence."""
