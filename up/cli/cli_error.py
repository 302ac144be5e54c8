"""Errors of ``up`` that the user can fix."""

from typing import Any

from up.errors import UserError


class CliError(UserError):
    """A verb failed; the text is one sentence, ``status`` the exit status."""

    def __init__(self, text: str, status: int = 1, code: str = "", **fields: Any) -> None:
        super().__init__(text, code, **fields)
        self.status = status


class UsageError(CliError):
    """A mistake in the arguments, which the parser cannot see: exit status 2."""

    def __init__(self, text: str, code: str = "") -> None:
        super().__init__(text, 2, code)
