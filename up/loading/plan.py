"""The modules to load, their order, and the reasons against the rest."""

from __future__ import annotations

import traceback
from collections.abc import Mapping
from dataclasses import field
from pathlib import Path
from typing import Any

from up.base_module import BaseModule
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command import BaseCommand
from up.errors import UserError
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class Rejected:
    """A discovered class that is not loaded, and the reason."""

    path: str
    reason: str
    code: str


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

    status = 2


@dataclass(frozen=True, slots=True)
class LoadProblem:
    """A file or class of the application, and the reason why it is not part of the system.

    ``name`` is the entry of ``disabled_modules.yml`` that accepts its absence. The daemon runs
    without it but does not arm. ``line`` is 0 where none is known.
    """

    name: str
    file: str
    what: str
    code: str
    line: int = 0

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.what}" if self.line else f"{self.file}: {self.what}"

    @property
    def fields(self) -> Mapping[str, Any]:
        return {"name": self.name, "file": self.file, "line": self.line}


def problem_of(name: str, path: Path, error: BaseException, code: str) -> LoadProblem:
    """Return the problem for an exception while importing or building, with its line."""
    if isinstance(error, SyntaxError) and error.filename:
        what = f"syntax: {error.msg}"
        return LoadProblem(name, error.filename, what, "syntax_error", error.lineno or 1)
    line = 0
    for frame in traceback.extract_tb(error.__traceback__):
        if Path(frame.filename) == path:
            line = frame.lineno or 0
    return LoadProblem(name, str(path), reason_of(error), code, line)


def reason_of(error: BaseException) -> str:
    """Return the type and text of an exception."""
    return f"{type(error).__name__}: {error}"


def path_of(cls: type) -> str:
    """Return the fully qualified name, as in ``disabled_modules.yml``."""
    return f"{cls.__module__}.{cls.__qualname__}"
