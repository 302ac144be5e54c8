"""What is wrong with configuration files, with its place, for people to mend."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from up.fields import printable


@dataclass(frozen=True, slots=True)
class ConfigProblem:
    """One mistake in one file: `line` and `column` count from 1."""

    path: Path
    line: int
    column: int
    what: str

    def __str__(self) -> str:
        return f"{printable(str(self.path))}:{self.line}:{self.column}: {self.what}"


class ConfigErrors(Exception):  # noqa: N818 - it carries many, and says so
    """All the problems that were found in one or more configuration files, one line each."""

    def __init__(self, problems: Sequence[ConfigProblem]) -> None:
        super().__init__("\n".join(str(problem) for problem in problems))
        self.problems = list(problems)
