"""Errors of ``up`` that the user can fix."""

from __future__ import annotations


class CliError(Exception):
    """A verb failed; the text is one sentence, ``status`` the exit status."""

    def __init__(self, text: str, status: int = 1) -> None:
        super().__init__(text)
        self.status = status
