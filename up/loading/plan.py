"""What is loaded, in which order, and why the rest is not."""

from __future__ import annotations

from dataclasses import dataclass, field

from up.base_module import BaseModule
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command import BaseCommand
from up.loading.problem import LoadProblem


@dataclass(frozen=True, slots=True)
class Rejected:
    """A class that was found and is not loaded, and why."""

    path: str
    reason: str


@dataclass(slots=True)
class Plan:
    """The modules in their order, the Commands and handlers, what was left out, what is broken."""

    modules: list[BaseModule] = field(default_factory=list)
    commands: list[type[BaseCommand]] = field(default_factory=list)
    handlers: list[BaseCommandHandler] = field(default_factory=list)
    rejected: list[Rejected] = field(default_factory=list)
    problems: list[LoadProblem] = field(default_factory=list)
    origins: dict[str, str] = field(default_factory=dict)
    left_out: dict[type[BaseModule], str] = field(default_factory=dict)
    """Why a module class that was found is not loaded, rejected or broken."""


class BootError(Exception):
    """The system cannot boot as it is configured; the text is one sentence."""
