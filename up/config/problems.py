"""Problems of configuration files, with their places, for people to fix."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from up.fields import printable

MAX_PROBLEMS = 100


@dataclass(frozen=True, slots=True)
class ConfigProblem:
    """One error in one file: `line` and `column` count from 1."""

    path: Path
    line: int
    column: int
    what: str

    def __str__(self) -> str:
        return f"{printable(str(self.path))}:{self.line}:{self.column}: {self.what}"


class ConfigErrors(Exception):  # noqa: N818 - it holds several errors
    """All the problems that were found in one or more configuration files, one line each."""

    def __init__(self, problems: Sequence[ConfigProblem]) -> None:
        super().__init__("\n".join(str(problem) for problem in problems))
        self.problems = list(problems)


class Problems:
    """Collects the problems of one file: at most MAX_PROBLEMS and a note that there are more."""

    def __init__(self, path: Path) -> None:
        self.found: list[ConfigProblem] = []
        self._path = path

    def report(self, line: int, column: int, what: str) -> None:
        """Add a problem; `line` and `column` count from 1."""
        if len(self.found) == MAX_PROBLEMS:
            what = f"more than {MAX_PROBLEMS} problems, the rest is not shown"
        if len(self.found) <= MAX_PROBLEMS:
            self.found.append(ConfigProblem(self._path, line, column, what))

    def raise_if_any(self) -> None:
        """Raise ConfigErrors if there are problems, in the order of the file."""
        if self.found:
            raise ConfigErrors(sorted(self.found, key=lambda each: (each.line, each.column)))
