"""Checks a whole application without starting it, and collects all problems."""

from collections.abc import Collection, Iterable, Iterator
from dataclasses import field
from pathlib import Path
from typing import Any

from up.base_module import BaseModule
from up.builtin_modules import BUILTIN_MODULES
from up.config import ConfigErrors, ConfigFile, unknown_files
from up.config.application import APPLICATION, DISABLED_MODULES
from up.context import Context
from up.errors import Problem, UserError
from up.fields import show
from up.flight_controller.base_board import ground_modes
from up.flight_modes.declarations import auto_mode_problem, usable
from up.flight_modes.flight_mode import FlightMode
from up.flight_modes.navigation_file import NAVIGATION
from up.loading.application import Application
from up.loading.commands import add_commands
from up.loading.discovery import Discovered, survey
from up.loading.order import order
from up.loading.plan import BootError, Plan, path_of
from up.loading.selection import select
from up.log.json_lines import RotatingFile
from up.quick_dataclass import dataclass


@dataclass(slots=True)
class Findings:
    """The result of a check."""

    problems: list[Problem] = field(default_factory=list)
    warnings: list[Problem] = field(default_factory=list)
    files: list[ConfigFile[Any]] = field(default_factory=list)
    plan: Plan = field(default_factory=Plan)


def check_application(
    application: Application, context: Context, more_files: Iterable[ConfigFile[Any]] = ()
) -> Findings:
    """Return every problem of configuration and modules in the context's mode, and the plan.

    ``more_files`` are configuration files that no module reads.
    """
    findings = Findings()
    read_files(context, (APPLICATION, DISABLED_MODULES), findings)
    disabled = context.config(DISABLED_MODULES).disabled_modules
    try:
        found = survey(application, disabled)
    except ConfigErrors as errors:
        findings.problems += errors.problems
        found = Discovered()
    findings.problems += found.cog_errors
    files = (*config_files((*BUILTIN_MODULES, *found.modules)), *more_files)
    findings.files = list(dict.fromkeys(files))
    read_files(context, findings.files, findings)
    _check_graph(context, found, disabled, findings)
    findings.problems += findings.plan.problems
    findings.problems += _flight_mode_problems(context, findings.plan)
    findings.warnings += _unknown(context.config_folder, findings.files)
    findings.warnings += _disabled_for_nothing(disabled, found)
    findings.warnings += _unwritable_log(context)
    findings.warnings += _plain_links(findings.plan)
    for file in findings.files:
        findings.warnings += file.ignored_keys(context.config_folder)
    return findings


def read_files(context: Context, files: Iterable[ConfigFile[Any]], findings: Findings) -> None:
    """Read configuration into the context; uses the defaults for an invalid file."""
    for file in files:
        try:
            context.config(file)
        except ConfigErrors as errors:
            findings.problems += errors.problems
            context.values[file] = file.cls()


def _check_graph(
    context: Context, found: Discovered, disabled: Collection[str], findings: Findings
) -> None:
    findings.plan.problems = list(found.problems)
    try:
        plan = findings.plan = select(found, BUILTIN_MODULES, context, disabled)
        add_commands(plan, found, disabled)
        # A module that needs one of a cog that cannot be imported would only repeat that error.
        if not found.cog_errors:
            plan.modules = order(plan.modules, plan.left_out)
    except BootError as error:
        findings.problems += error.problems


def _flight_mode_problems(context: Context, plan: Plan) -> Iterator[Problem]:
    """Yield what a start would report as an arming veto."""
    modes, problems = usable(each for each in plan.modules if isinstance(each, FlightMode))
    for path, text in problems.items():
        yield UserError(text, "flight_mode_invalid", name=path, origin=plan.origins[path])
    if any(each.CONFIG is NAVIGATION for each in plan.modules):
        name = context.config(NAVIGATION).auto_mode
        text = auto_mode_problem(name, {*modes, *ground_modes(plan.modules)}) or ""
        if text:
            file = context.config_folder / NAVIGATION.filename
            yield UserError(text, "flight_mode_unknown", file=file, key="auto_mode", value=name)


def _unknown(folder: Path, files: Iterable[ConfigFile[Any]]) -> Iterator[UserError]:
    for path in unknown_files(folder, files):
        text = f"{path}: no module of this application reads this file"
        yield UserError(text, "file_unused", file=path)


def _disabled_for_nothing(disabled: Iterable[str], found: Discovered) -> Iterator[UserError]:
    classes = (*BUILTIN_MODULES, *found.modules, *found.commands, *found.handlers)
    known = {path_of(cls) for cls in classes} | {cls.__module__ for cls in classes}
    for name in disabled:
        if name not in known | found.disabled_files:
            file = DISABLED_MODULES.filename
            text = f"{file}: {name} does not exist, so it cannot be disabled"
            yield UserError(text, "module_unknown", file=file, name=name)


def _unwritable_log(context: Context) -> Iterator[UserError]:
    file, log_file = APPLICATION.filename, context.application.log_file
    try:
        if log_file:
            RotatingFile(Path(log_file), 0, 0).probe()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        text = f"{file}: log file: the user of this check cannot write {show(log_file)}: {reason}"
        text += " (a service runs as another user, who must be able to)"
        yield UserError(text, "log_file_unwritable", file=file, key="log file", value=log_file)


def _plain_links(plan: Plan) -> Iterator[UserError]:
    for module in plan.modules:
        for key, what in module.plain_links():
            file = "" if module.CONFIG is None else module.CONFIG.filename
            text = f"{file}: {key}: {what}"
            yield UserError(text, "link_plain", file=file, key=key)


def config_files(modules: Iterable[BaseModule | type[BaseModule]]) -> list[ConfigFile[Any]]:
    """Return the files of the application as a whole and of the modules, each once."""
    files: list[ConfigFile[Any]] = [APPLICATION, DISABLED_MODULES]
    for module in modules:
        files += (*filter(None, (module.CONFIG,)), *module.WRITTEN_FILES)
    return list(dict.fromkeys(files))
