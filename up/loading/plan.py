"""The modules to load, their order, and the reasons against the rest."""

from __future__ import annotations

from dataclasses import dataclass, field

from up.base_module import BaseModule
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command import BaseCommand
from up.loading.problem import LoadProblem


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


class BootError(Exception):
    """The configured system cannot boot; the text is one sentence."""
