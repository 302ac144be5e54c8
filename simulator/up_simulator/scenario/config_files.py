"""The daemon's configuration files by name, as far as it is installed here."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from up.builtin_modules import BUILTIN_MODULES
from up.cli.system import cog_files, program_files
from up.config import ConfigErrors, ConfigFile
from up.loading.application import Application, NoApplicationError
from up.loading.discovery import survey
from up.loading.files import config_files
from up.loading.plan import BootError

ROOT = Path(__file__).resolve().parents[3]


@cache
def daemon_files() -> dict[str, ConfigFile[Any]]:
    """Return the files that the daemon reads; none where there is no daemon beside the simulator.

    What is none of these is judged by the daemon itself when it starts.
    """
    try:
        application = Application.find(ROOT)
        found = survey(application)
    except (NoApplicationError, ConfigErrors, BootError):
        return {}
    files = [*config_files((*BUILTIN_MODULES, *found.modules)), *cog_files(application)]
    return {file.filename: file for file in (*program_files(), *files)}
