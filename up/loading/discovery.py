"""Finds the classes of an application and its cogs."""

import importlib
import inspect
import pkgutil
import sys
from collections.abc import Iterable, Iterator
from dataclasses import field
from types import ModuleType

from up.base_module import BaseModule
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command import BaseCommand
from up.errors import UserError
from up.loading.application import Application
from up.loading.external_modules import EXTERNAL_MODULES, CogEntry
from up.loading.plan import LoadProblem, problem_of, reason_of
from up.quick_dataclass import dataclass

# The import of a file may raise anything, and one that exits must not end the program.
IMPORT_FAULTS = (Exception, SystemExit)
MODULE_FOLDERS = ("modules", "flight_modes", "flight_controller")
COMMAND_FOLDER = "commands"


class CogImportError(UserError):
    """A registered cog cannot be imported; the text is one sentence that names the remedy."""

    status = 2


@dataclass(slots=True)
class Discovered:
    """The classes found, in the order of discovery, and the problems."""

    modules: list[type[BaseModule]] = field(default_factory=list)
    commands: list[type[BaseCommand]] = field(default_factory=list)
    handlers: list[type[BaseCommandHandler]] = field(default_factory=list)
    origins: dict[type, str] = field(default_factory=dict)
    problems: list[LoadProblem] = field(default_factory=list)
    cog_errors: list[CogImportError] = field(default_factory=list)
    disabled_files: set[str] = field(default_factory=set)

    def add(self, cls: type, origin: str) -> None:
        """Add a class to the list of its base class; repeated classes count once."""
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
    """Return the classes of an application and its registered cogs.

    A registered cog that cannot be imported raises CogImportError, one sentence for each class; a
    broken file of the application itself is a problem in the result, unless ``disabled`` lists its
    name.
    """
    found = survey(application, disabled)
    if found.cog_errors:
        raise CogImportError.group(found.cog_errors)
    return found


def survey(application: Application, disabled: Iterable[str] = ()) -> Discovered:
    """Return the same as ``discover``, with the cogs' errors in the result; raises ConfigErrors."""
    found = Discovered()
    for cog, entry in EXTERNAL_MODULES.load(application.root).items():
        _discover_cog(found, cog, entry)
    application.make_importable()
    for folder in (*MODULE_FOLDERS, COMMAND_FOLDER):
        discover_folder(found, application, folder, frozenset(disabled))
    return found


def _discover_cog(found: Discovered, cog: str, entry: CogEntry) -> None:
    for each in entry.modules:
        try:
            cls = getattr(importlib.import_module(each.prefix), each.class_name)
        except IMPORT_FAULTS as error:
            what = (
                f"the registered cog {cog} cannot be imported ({each.path}: {reason_of(error)}):"
                " install it with 'up gather', or take it out of Cogfile.yml and run 'up gather'"
            )
            found.cog_errors.append(_cog_error(what, cog, each.path, error))
            continue
        if not (inspect.isclass(cls) and issubclass(cls, BaseModule)):
            what = f"{each.path} of the cog {cog} is not a module: it does not extend BaseModule"
            found.cog_errors.append(
                CogImportError(what, "not_a_module", cog=cog, name=each.path, reason="")
            )
            continue
        found.add(cls, cog)
    for module in _command_modules(found, cog):
        for cls in _classes_of(module):
            found.add(cls, cog)


def _command_modules(found: Discovered, cog: str) -> Iterator[ModuleType]:
    package = f"{cog}.{COMMAND_FOLDER}"
    try:
        place = importlib.import_module(package).__path__
    except IMPORT_FAULTS as error:
        # A cog may have no Commands; a missing cog was reported with its modules.
        if not (isinstance(error, ModuleNotFoundError) and error.name in (cog, package)):
            found.cog_errors.append(_no_commands(package, cog, error))
        return
    for info in pkgutil.iter_modules(place):
        name = f"{package}.{info.name}"
        try:
            yield importlib.import_module(name)
        except IMPORT_FAULTS as error:
            found.cog_errors.append(_no_commands(name, cog, error))


def _no_commands(name: str, cog: str, error: BaseException) -> CogImportError:
    what = f"the Commands of the cog {cog} cannot be imported ({name}: {reason_of(error)})"
    return _cog_error(what, cog, name, error)


def _cog_error(what: str, cog: str, name: str, error: BaseException) -> CogImportError:
    fields = {"cog": cog, "name": name, "reason": type(error).__name__}
    return CogImportError(what, "cog_import_failed", **fields)


def discover_folder(
    found: Discovered, application: Application, folder: str, disabled: frozenset[str]
) -> None:
    """Add the classes of every Python file of one folder; a broken file is a problem."""
    place = application.root / folder
    if not place.is_dir():
        return
    for path in sorted(place.glob("*.py")):
        if path.name.startswith(("_", ".")) or path.is_dir():
            continue
        name = f"{application.package}.{folder}.{path.stem}"
        if name in disabled:
            found.disabled_files.add(name)
            continue
        if not path.stem.isidentifier():
            what = "the file's name is not a Python identifier"
            found.problems.append(LoadProblem(name, str(path), what, "name_invalid"))
            continue
        try:
            module = importlib.import_module(name)
        except IMPORT_FAULTS as error:
            sys.modules.pop(name, None)
            found.problems.append(problem_of(name, path, error, "import_failed"))
            continue
        for cls in _classes_of(module):
            found.add(cls, str(path.relative_to(application.root)))


def _classes_of(module: ModuleType) -> Iterator[type]:
    """Yield the loadable classes that a module defines itself, without helpers and imports."""
    for cls in vars(module).values():
        if not inspect.isclass(cls) or cls.__module__ != module.__name__:
            continue
        if cls.__name__.startswith("_") or inspect.isabstract(cls):
            continue
        if issubclass(cls, BaseModule | BaseCommand | BaseCommandHandler):
            yield cls
