"""Adds the discovered Commands and handlers to the plan."""

import inspect
from collections.abc import Callable, Container

from up.commands.base_command_handler import BaseCommandHandler
from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command import BaseCommand
from up.commands.command_registry import CommandRegistry, DuplicateCommandError
from up.loading.discovery import IMPORT_FAULTS, Discovered
from up.loading.plan import LoadProblem, Plan, Rejected, path_of, reason_of

_REGISTRATION_FAULTS = (DuplicateCommandError, ValueError, TypeError, NameError)


def add_commands(plan: Plan, found: Discovered, disabled: Container[str]) -> None:
    """Add the valid Commands, and the handlers that register themselves.

    A broken one becomes a problem, a disabled one is rejected, and a rejected Command's handlers
    are rejected too.
    """
    registry = CommandRegistry(BUILTIN_COMMANDS)
    for cls in found.commands:
        if _is_rejected(plan, cls, disabled):
            continue
        try:
            registry.add(cls)
        except _REGISTRATION_FAULTS as error:
            plan.problems.append(_problem(cls, found, str(error), "command_invalid"))
        else:
            plan.commands.append(cls)
    for handler in found.handlers:
        if handler.COMMAND and not _is_rejected(plan, handler, disabled):
            _add_handler(plan, found, handler, registry)


def _add_handler(
    plan: Plan, found: Discovered, cls: type[BaseCommandHandler], registry: CommandRegistry
) -> None:
    if cls.COMMAND in found.commands and cls.COMMAND not in plan.commands:
        reason = f"its Command {getattr(cls.COMMAND, '__name__', cls.COMMAND)} is not loaded"
        plan.rejected.append(Rejected(path_of(cls), reason, "command_not_loaded"))
        return
    make: Callable[[], BaseCommandHandler] = cls
    try:
        _check_command(cls, registry)
        plan.handlers.append(make())
    except IMPORT_FAULTS as error:
        text = str(error) if isinstance(error, _NoCommandError) else reason_of(error)
        plan.problems.append(_problem(cls, found, text, "handler_invalid"))


class _NoCommandError(Exception):
    """The Command that a handler names cannot be published."""


def _check_command(cls: type[BaseCommandHandler], registry: CommandRegistry) -> None:
    command: object = cls.COMMAND
    if isinstance(command, str):
        return
    if not (inspect.isclass(command) and issubclass(command, BaseCommand)):
        raise _NoCommandError(
            f"{cls.__name__}.COMMAND is {command!r}: it must be a Command class or the name of one"
        )
    try:
        registry.add(command)
    except _REGISTRATION_FAULTS as error:
        raise _NoCommandError(f"{cls.__name__}.COMMAND: {error}") from error


def _is_rejected(plan: Plan, cls: type, disabled: Container[str]) -> bool:
    if path_of(cls) not in disabled and cls.__module__ not in disabled:
        return False
    plan.rejected.append(Rejected(path_of(cls), "listed in disabled_modules.yml", "disabled"))
    return True


def _problem(cls: type, found: Discovered, what: str, code: str) -> LoadProblem:
    return LoadProblem(path_of(cls), found.origins[cls], what, code)
