"""The reason why a file or class could not be loaded."""

from __future__ import annotations

import traceback
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class LoadProblem:
    """A file or class of the application, and the reason why it is not part of the system.

    ``name`` is the entry of ``disabled_modules.yml`` that accepts its absence. The daemon runs
    without it but does not arm.
    """

    name: str
    where: str
    what: str

    def __str__(self) -> str:
        return f"{self.where}: {self.what}"


def problem_of(name: str, path: Path, error: BaseException) -> LoadProblem:
    """Return the problem for an exception while importing or building, with its line."""
    if isinstance(error, SyntaxError) and error.filename:
        return LoadProblem(name, f"{error.filename}:{error.lineno or 1}", f"syntax: {error.msg}")
    line = None
    for frame in traceback.extract_tb(error.__traceback__):
        if Path(frame.filename) == path:
            line = frame.lineno
    where = str(path) if line is None else f"{path}:{line}"
    return LoadProblem(name, where, f"{type(error).__name__}: {error}")
