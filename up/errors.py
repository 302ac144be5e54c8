"""Errors that the user can fix."""

from __future__ import annotations


class UserError(Exception):
    """An error with a text of one or more sentences for the user; ``code`` names its kind."""

    def __init__(self, text: str, code: str = "") -> None:
        super().__init__(text)
        self.code = code
