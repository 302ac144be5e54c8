"""The configuration files that a set of modules reads."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from up.base_module import BaseModule
from up.config import ConfigFile
from up.config.application import APPLICATION
from up.config.disabled_modules import DISABLED_MODULES


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
