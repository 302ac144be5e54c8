"""The system that a verb inspects, without starting it."""

from __future__ import annotations

import argparse
import importlib.metadata
import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from twisted.internet.task import Clock

from up.cli.cli_error import CliError
from up.cli.locate import application_of
from up.cogs.cog import CogError
from up.cogs.cogfile import COGFILE, load_cogfile
from up.cogs.registration import find_registrant
from up.config import ConfigErrors, ConfigFile
from up.context import Context
from up.loading.application import Application
from up.loading.external_modules import EXTERNAL_MODULES
from up.loading.plan import BootError
from up.program import make_context

PROGRAM_FILES = "up.config_files"


@dataclass(slots=True)
class System:
    """An application, and the context in which it would run."""

    application: Application
    context: Context


def system_of(values: argparse.Namespace) -> System:
    """Return the application and context of ``--file``, ``--config``, ``--mode`` and UP_MODE.

    Raises CliError or NoApplicationError; uses the defaults for an invalid config.yml.
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
    except BootError as error:
        raise CliError(str(error), status=2) from error
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
            registrant = find_registrant(cog)
        except CogError:
            continue
        yield from getattr(registrant, "CONFIG_FILES", ())


def cogfile_problems(application: Application) -> Iterator[str]:
    """Yield the errors in the Cogfile and its cogs that are not registered."""
    try:
        wanted = load_cogfile(application.root)
        registered = EXTERNAL_MODULES.load(application.root)
    except ConfigErrors as errors:
        yield from map(str, errors.problems)
        return
    for each in wanted:
        if each.cog not in registered:
            yield (
                f"{application.root / COGFILE}: {each.cog} is wanted and not registered: run"
                " 'up gather'"
            )
