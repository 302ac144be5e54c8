"""The modules to load, their order, and the reasons against the rest."""

from __future__ import annotations

import traceback
from dataclasses import dataclass, field
from pathlib import Path

from up.base_module import BaseModule
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command import BaseCommand
from up.errors import UserError


@dataclass(frozen=True, slots=True)
class Rejected:
    """A discovered class that is not loaded, and the reason."""

    path: str
    reason: str


@dataclass(slots=True)
class Plan:
    """The modules in order, the Commands and handlers, the classes left out, the problems."""

    modules: list[BaseModule] = field(default_factory=list)
    commands: list[type[BaseCommand]] = field(default_factory=list)
    handlers: list[BaseCommandHandler] = field(default_factory=list)
    rejected: list[Rejected] = field(default_factory=list)
    problems: list[LoadProblem] = field(default_factory=list)
    origins: dict[str, str] = field(default_factory=dict)
    left_out: dict[type[BaseModule], str] = field(default_factory=dict)
    """The reason why a discovered module class is left out, rejected or broken."""


class BootError(UserError):
    """The configured system cannot boot; the text is one sentence."""


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
