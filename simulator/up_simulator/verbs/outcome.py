"""The outcome of a verb: its exit status, or a sentence about the user's request."""

from __future__ import annotations

HELD, NOT_HELD, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130


class FailedError(Exception):
    """The request cannot be carried out here: one sentence, exit status 1."""


class UsageError(Exception):
    """The request names a missing thing: one sentence, exit status 2."""
