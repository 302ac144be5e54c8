"""Turns an application into a running Up: discover, select, order, build (thesis 4.1.3)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from up.builtin_modules import BUILTIN_MODULES
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command_registry import CommandRegistry, DuplicateCommandError
from up.config.disabled_modules import DISABLED_MODULES
from up.context import Context
from up.loading.application import Application
from up.loading.discovery import Discovered, discover
from up.loading.order import order
from up.loading.plan import Plan
from up.loading.problem import LoadProblem
from up.loading.selection import select
from up.up import Up


class UpLoader:
    """Loads an application.

    ``plan`` says what would be loaded without starting anything; ``create`` builds the system from
    it. Raises ConfigErrors, CogImportError or BootError, each a sentence for the user.
    """

    def __init__(self, application: Application, context: Context) -> None:
        self._application = application
        self._context = context

    def plan(self) -> Plan:
        """Return the ordered modules, the Commands, and why the rest is left out."""
        disabled = self._context.config(DISABLED_MODULES).disabled_modules or ()
        found = discover(self._application, disabled)
        plan = select(found, BUILTIN_MODULES, self._context, disabled)
        plan.modules = order(plan.modules, plan.left_out)
        take_commands(plan, found)
        plan.handlers = build_handlers(plan, found)
        return plan

    def create(self) -> Up:
        """Return the system, initialized and ready to be started."""
        up = Up(self.plan(), self._context)
        up.initialize()
        return up


def take_commands(plan: Plan, found: Discovered) -> None:
    """Add the Commands that can be registered to the plan, the others to its problems."""
    registry = CommandRegistry(BUILTIN_COMMANDS)
    for cls in found.commands:
        path = f"{cls.__module__}.{cls.__qualname__}"
        try:
            registry.add(cls)
        except (DuplicateCommandError, ValueError, TypeError, NameError) as error:
            plan.problems.append(LoadProblem(path, found.origins[cls], str(error)))
        else:
            plan.commands.append(cls)


def build_handlers(plan: Plan, found: Discovered) -> list[BaseCommandHandler]:
    """Return the handlers that register themselves; one that cannot be built is a problem."""
    built: list[BaseCommandHandler] = []
    for cls in found.handlers:
        if not cls.COMMAND:
            continue
        make: Callable[[], BaseCommandHandler] = cls
        try:
            built.append(make())
        except Exception as error:  # noqa: BLE001 - a broken handler must not keep the rest away
            path = f"{cls.__module__}.{cls.__qualname__}"
            text = f"{type(error).__name__}: {error}"
            plan.problems.append(LoadProblem(path, found.origins[cls], text))
    return built


def load_application(start: Path, context: Context) -> Up:
    """Find the application that a folder belongs to and return its system."""
    return UpLoader(Application.find(start), context).create()
