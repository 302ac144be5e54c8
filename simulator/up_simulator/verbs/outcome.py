"""What a verb comes to: its exit status, or a sentence about what the user asked for."""

from __future__ import annotations

HELD, NOT_HELD, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130


class FailedError(Exception):
    """What the user asked for cannot be done here: one sentence, exit status 1."""


class UsageError(Exception):
    """The user asked for something that is not there: one sentence, exit status 2."""
