"""The verbs that inspect, start or extend an existing application."""

from __future__ import annotations

import argparse
import importlib.metadata
import json
import os
from collections.abc import Iterable, Iterator
from typing import Any

from twisted.internet.task import Clock

from up.cli.locate import application_of
from up.cli.option_parser import EXIT_OK, EXIT_USAGE
from up.cogs import gather as cog_gather
from up.cogs import registration
from up.cogs.cog import CogError, package_name
from up.cogs.cogfile import COGFILE, load_cogfile
from up.config import ConfigErrors, ConfigFile, no_configuration, write_schemas
from up.context import Context
from up.errors import Problem
from up.flight_modes.flight_mode import FlightMode
from up.loading.application import UP_FILE_CONFIG, Application
from up.loading.checking import Findings, check_application
from up.loading.external_modules import EXTERNAL_MODULES
from up.loading.plan import Plan
from up.output import echo, print_problems
from up.program import make_context, run_application
from up.quick_dataclass import dataclass

PROGRAM_FILES = "up.config_files"


def start(values: argparse.Namespace) -> int:
    """Run the application until it is stopped."""
    return run_application(application_of(values).root, values.config, use_defaults=values.defaults)


def gather(values: argparse.Namespace) -> int:
    """Install and register the cogs of the Cogfile."""
    cog_gather.gather(application_of(values), may_install=not values.no_install)
    return EXIT_OK


def register(values: argparse.Namespace) -> int:
    """Register or unregister one installed cog."""
    application = application_of(values)
    cog = package_name(values.name)
    if values.remove:
        return 0 if registration.unregister(cog, application) else 1
    registration.register(cog, application, "manual")
    return EXIT_OK


def check(values: argparse.Namespace) -> int:
    """Check configuration and module graph; report all problems and warnings."""
    system = system_of(values)
    findings = system.check(*cog_files(system.application), *program_files())
    problems = [*_cogfile_problems(system.application), *findings.problems]
    folder, mode = system.context.config_folder, system.context.mode.value
    nothing = no_configuration(folder, findings.files)
    if nothing is not None and not values.defaults:
        problems.append(nothing)
    print_problems(findings.warnings, "warning")
    print_problems(problems)
    if problems:
        count = len(set(map(str, problems)))
        text = f"{count} {'mistake' if count == 1 else 'mistakes'} to fix"
        echo(text, "check_failed", count=count)
        return EXIT_USAGE
    modules, files = len(findings.plan.modules), len(findings.files)
    text = f"no mistakes: {modules} modules in the mode '{mode}', {files} configuration files"
    fields = {"modules": modules, "mode": mode, "files": files, "folder": folder}
    echo(f"{text} for {folder}", "check_passed", **fields)
    return EXIT_OK


def modules(values: argparse.Namespace) -> int:
    """Show which modules would be loaded, in which order, and why others are left out."""
    system = system_of(values)
    findings = system.check()
    plan = findings.plan
    if values.json:
        echo(json.dumps(_document(system, plan), indent=1))
    else:
        _show(system, plan)
    print_problems((*_cogfile_problems(system.application), *findings.problems))
    return EXIT_USAGE if findings.problems else EXIT_OK


def _document(system: System, plan: Plan) -> dict[str, Any]:
    """Return the plan for programs; ``origin`` is empty for a module of Up itself."""
    origins = plan.origins
    return {
        "mode": system.context.mode.value,
        "modules": [
            {
                "path": each.path,
                "origin": origins.get(each.path, ""),
                **({"flight_mode": each.NAME} if isinstance(each, FlightMode) else {}),
            }
            for each in plan.modules
        ],
        "rejected": [{"path": each.path, "reason": each.reason} for each in plan.rejected],
        "commands": [cls.NAME for cls in plan.commands],
    }


def _show(system: System, plan: Plan) -> None:
    echo(f"mode: {system.context.mode.value}")
    echo("loaded, in this order:")
    _table(
        (str(number), module.path, plan.origins.get(module.path, ""))
        for number, module in enumerate(plan.modules, 1)
    )
    modes = [each for each in plan.modules if isinstance(each, FlightMode)]
    if modes:
        echo("flight modes:")
        _table(
            ("", each.NAME, f"falls back to {each.FALLBACK}" if each.FALLBACK else "")
            for each in modes
        )
    if plan.rejected:
        echo("not loaded:")
        _table(("", each.path, each.reason) for each in plan.rejected)
    if plan.commands:
        echo("further Commands:")
        _table(("", cls.NAME, f"{cls.__module__}.{cls.__qualname__}") for cls in plan.commands)


def schemas(values: argparse.Namespace) -> int:
    """Write the JSON Schema of every configuration file, and print how to set up an editor."""
    system = system_of(values)
    findings = system.check(UP_FILE_CONFIG, *cog_files(system.application), *program_files())
    for path in write_schemas(findings.files, values.folder):
        echo(str(path))
    echo(
        "An editor with a YAML language server takes one by a first line like"
        " '# yaml-language-server: $schema=config.schema.json'"
    )
    return EXIT_OK


@dataclass(slots=True)
class System:
    """An application, and the context in which it would run."""

    application: Application
    context: Context

    def check(self, *more_files: ConfigFile[Any]) -> Findings:
        return check_application(self.application, self.context, more_files)


def system_of(values: argparse.Namespace) -> System:
    """Return the application and context of ``--file``, ``--config``, ``--mode`` and UP_MODE.

    Raises UserError; uses the defaults for an invalid config.yml.
    """
    application = application_of(values)
    folder = getattr(values, "config", None)
    environ = dict(os.environ)
    if getattr(values, "mode", None):
        environ["UP_MODE"] = values.mode
    try:
        context = make_context(application, Clock(), folder, environ)
    except ConfigErrors:
        # The check of the configuration reports the same errors; without a mode it cannot run.
        environ.setdefault("UP_MODE", "auto")
        context = make_context(application, Clock(), folder, environ)
    return System(application, context)


def program_files() -> Iterator[ConfigFile[Any]]:
    """Yield the configuration files that installed programs announce as entry points."""
    for entry in importlib.metadata.entry_points(group=PROGRAM_FILES):
        try:
            file = entry.load()
        except (ImportError, AttributeError):
            continue
        if isinstance(file, ConfigFile):
            yield file


def cog_files(application: Application) -> Iterator[ConfigFile[Any]]:
    """Yield the configuration files that the registered cogs create."""
    try:
        cogs = list(EXTERNAL_MODULES.load(application.root))
    except ConfigErrors:
        return
    for cog in cogs:
        try:
            registrant = registration.find_registrant(cog)
        except CogError:
            continue
        yield from getattr(registrant, "CONFIG_FILES", ())


def _cogfile_problems(application: Application) -> Iterator[Problem]:
    """Yield the errors in the Cogfile and its cogs that are not registered."""
    try:
        wanted = load_cogfile(application.root)
        registered = EXTERNAL_MODULES.load(application.root)
    except ConfigErrors as errors:
        yield from errors.problems
        return
    for each in wanted:
        if each.cog not in registered:
            file = application.root / COGFILE
            text = f"{file}: {each.cog} is not registered: run 'up gather'"
            yield CogError(text, "not_registered", file=file, cog=each.cog)


def _table(rows: Iterable[tuple[str, str, str]]) -> None:
    lines = list(rows)
    width = max((len(name) for _, name, _ in lines), default=0)
    for first, name, last in lines:
        echo(f"  {first:>2}  {name:<{width}}  {last}")
