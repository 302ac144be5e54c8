"""Finds the classes that an application and its cogs bring."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from types import ModuleType

from up.base_module import BaseModule
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command import BaseCommand
from up.loading.application import Application
from up.loading.external_modules import EXTERNAL_MODULES, CogEntry
from up.loading.problem import LoadProblem, problem_of

MODULE_FOLDERS = ("modules", "flight_controller")
COMMAND_FOLDER = "commands"


class CogImportError(Exception):
    """A registered cog cannot be imported; the text is one sentence that names the way out."""


@dataclass(slots=True)
class Discovered:
    """The classes that were found, in the order of finding, and what could not be read."""

    modules: list[type[BaseModule]] = field(default_factory=list)
    commands: list[type[BaseCommand]] = field(default_factory=list)
    handlers: list[type[BaseCommandHandler]] = field(default_factory=list)
    origins: dict[type, str] = field(default_factory=dict)
    problems: list[LoadProblem] = field(default_factory=list)

    def add(self, cls: type, origin: str) -> None:
        """Put a class where its base class belongs; one that was found before stays once."""
        if cls in self.origins:
            return
        self.origins[cls] = origin
        if issubclass(cls, BaseModule):
            self.modules.append(cls)
        elif issubclass(cls, BaseCommand):
            self.commands.append(cls)
        elif issubclass(cls, BaseCommandHandler):
            self.handlers.append(cls)


def discover(application: Application, disabled: Iterable[str] = ()) -> Discovered:
    """Return what an application and its registered cogs bring.

    A registered cog that cannot be imported raises CogImportError; a broken file of the
    application's own is a problem in the result, unless ``disabled`` lists its name.
    """
    found = Discovered()
    for cog, entry in EXTERNAL_MODULES.load(application.root).items():
        _discover_cog(found, cog, entry)
    application.make_importable()
    for folder in (*MODULE_FOLDERS, COMMAND_FOLDER):
        _discover_folder(found, application, folder, frozenset(disabled))
    return found


def _discover_cog(found: Discovered, cog: str, entry: CogEntry) -> None:
    for each in entry.modules:
        try:
            cls = getattr(importlib.import_module(each.prefix), each.class_name)
        except Exception as error:
            reason = f"{type(error).__name__}: {error}"
            raise CogImportError(
                f"the registered cog {cog} cannot be imported ({each.path}: {reason}): install"
                f" it with 'up gather', or take it out of Cogfile.yml and run 'up gather'"
            ) from error
        if not (inspect.isclass(cls) and issubclass(cls, BaseModule)):
            raise CogImportError(
                f"{each.path} of the cog {cog} is no module: it does not extend BaseModule"
            )
        found.add(cls, cog)
    package = _commands_package(cog)
    if package is not None:
        for module in _package_modules(package):
            for cls in _classes_of(module):
                found.add(cls, cog)


def _commands_package(cog: str) -> ModuleType | None:
    try:
        return importlib.import_module(f"{cog}.{COMMAND_FOLDER}")
    except ModuleNotFoundError as error:
        if error.name in (cog, f"{cog}.{COMMAND_FOLDER}"):
            return None
        raise CogImportError(
            f"the Commands of the cog {cog} cannot be imported: {error}"
        ) from error


def _package_modules(package: ModuleType) -> Iterator[ModuleType]:
    for info in pkgutil.iter_modules(package.__path__):
        yield importlib.import_module(f"{package.__name__}.{info.name}")


def _discover_folder(
    found: Discovered, application: Application, folder: str, disabled: frozenset[str]
) -> None:
    place = application.root / folder
    if not place.is_dir():
        return
    for path in sorted(place.glob("*.py")):
        if path.name.startswith(("_", ".")):
            continue
        name = f"{application.package}.{folder}.{path.stem}"
        if name in disabled:
            continue
        if not path.stem.isidentifier():
            found.problems.append(
                LoadProblem(name, str(path), "the file's name is no Python identifier")
            )
            continue
        try:
            module = importlib.import_module(name)
        except Exception as error:  # noqa: BLE001 - a broken file must not keep the rest from flying
            sys.modules.pop(name, None)
            found.problems.append(problem_of(name, path, error))
            continue
        for cls in _classes_of(module):
            found.add(cls, str(path.relative_to(application.root)))


def _classes_of(module: ModuleType) -> Iterator[type]:
    """Yield the loadable classes that a module defines itself; helpers and imports are not."""
    for cls in vars(module).values():
        if not inspect.isclass(cls) or cls.__module__ != module.__name__:
            continue
        if cls.__name__.startswith("_") or inspect.isabstract(cls):
            continue
        if issubclass(cls, BaseModule | BaseCommand | BaseCommandHandler):
            yield cls
