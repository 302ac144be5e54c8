"""What a module's start came to (thesis 4.1.3)."""

from __future__ import annotations

from enum import Enum


class StartResult(Enum):
    """How the boot goes on after a module's start."""

    STARTED = "started"
    FAILED_GO_ON = "failed, go on"
    FAILED_STOP = "failed, stop"


class StartFailedError(Exception):
    """Raised by a start that failed for a reason that a user can mend; the text is one sentence."""
