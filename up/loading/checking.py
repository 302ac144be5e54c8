"""Checks a whole application without starting it, and collects all problems."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from up.base_module import BaseModule
from up.builtin_modules import BUILTIN_MODULES
from up.config import ConfigErrors, ConfigFile, unknown_files
from up.config.application import APPLICATION, DISABLED_MODULES
from up.context import Context
from up.loading.application import Application
from up.loading.commands import add_commands
from up.loading.discovery import Discovered, survey
from up.loading.order import order
from up.loading.plan import BootError, Plan
from up.loading.selection import select


@dataclass(slots=True)
class Findings:
    """The result of a check: sentences for people, each with its place if it has one."""

    problems: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
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
        findings.problems += map(str, errors.problems)
        found = Discovered()
    findings.problems += found.cog_errors
    files = (*config_files((*BUILTIN_MODULES, *found.modules)), *more_files)
    findings.files = list(dict.fromkeys(files))
    read_files(context, findings.files, findings)
    _check_graph(context, found, disabled, findings)
    findings.problems += map(str, findings.plan.problems)
    findings.warnings += _unknown(context.config_folder, findings.files)
    findings.warnings += _disabled_for_nothing(disabled, found)
    return findings


def read_files(context: Context, files: Iterable[ConfigFile[Any]], findings: Findings) -> None:
    """Read configuration into the context; uses the defaults for an invalid file."""
    for file in files:
        try:
            context.config(file)
        except ConfigErrors as errors:
            findings.problems += map(str, errors.problems)
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
        findings.problems += str(error).splitlines()


def _unknown(folder: Path, files: Iterable[ConfigFile[Any]]) -> list[str]:
    return [
        f"{path}: no module of this application reads this file"
        for path in unknown_files(folder, files)
    ]


def _disabled_for_nothing(disabled: Iterable[str], found: Discovered) -> list[str]:
    classes = (*BUILTIN_MODULES, *found.modules, *found.commands, *found.handlers)
    known = {f"{cls.__module__}.{cls.__qualname__}" for cls in classes}
    known |= {cls.__module__ for cls in classes} | found.disabled_files
    return [
        f"{DISABLED_MODULES.filename}: {name} does not exist, so it cannot be disabled"
        for name in disabled
        if name not in known
    ]


def config_files(modules: Iterable[BaseModule | type[BaseModule]]) -> list[ConfigFile[Any]]:
    """Return the files of the application as a whole and of the modules, each once."""
    files: list[ConfigFile[Any]] = [APPLICATION, DISABLED_MODULES]
    files += [module.CONFIG for module in modules if module.CONFIG is not None]
    return list(dict.fromkeys(files))


def no_configuration(folder: Path, files: Iterable[ConfigFile[Any]]) -> str:
    """Return the error for a folder without any of the files, or an empty text."""
    if any((folder / file.filename).exists() for file in files):
        return ""
    return f"{folder}: no configuration file is here; start with --defaults to use the defaults"
