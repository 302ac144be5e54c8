"""Errors that the user can fix."""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol, Self


class Problem(Protocol):
    """One thing to correct: its text (``str``), a code that names its kind, the values in it."""

    @property
    def code(self) -> str: ...

    @property
    def fields(self) -> Mapping[str, Any]: ...


class UserError(Exception):
    """An error that the user can fix, or a group of them; ``status`` is the exit status."""

    status = 1

    def __init__(self, text: str, code: str = "", **fields: Any) -> None:
        super().__init__(text)
        self.code = code
        self.fields: Mapping[str, Any] = fields
        self._members: Sequence[Problem] = ()

    @property
    def problems(self) -> Sequence[Problem]:
        """Return the errors of a group, otherwise this one."""
        return self._members or (self,)

    @classmethod
    def group(cls, errors: Sequence[Self]) -> Self:
        """Return one error with the texts of several, which must not be empty."""
        found = cls("\n".join(map(str, errors)), errors[0].code)
        found._members = [problem for error in errors for problem in error.problems]
        return found
