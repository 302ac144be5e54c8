"""``up explore``: lists the module classes in a folder (thesis 4.3.2)."""

import argparse
import json
from dataclasses import asdict
from pathlib import Path

from up.base_module import BaseModule
from up.cli.cli_error import CliError
from up.cogs.manifest import MANIFEST_FILE, write_manifest
from up.cogs.registration import REGISTRANT_MODULE
from up.loading.application import UP_FILE, Application
from up.loading.discovery import MODULE_FOLDERS, Discovered, discover_folder
from up.loading.external_modules import ModuleEntry
from up.output import echo, print_problems


def run(values: argparse.Namespace) -> int:
    """List the module classes, and write the manifest on request."""
    start = Path(values.file) if values.file else Path.cwd()
    if values.type == "recorders":
        text = "recorders were replaced by Thread Modules, see 'up create module -t thread'"
        echo("[]" if values.json else text)
        return 0
    package = package_at(start.resolve())
    found = Discovered()
    package.make_importable()
    for folder in MODULE_FOLDERS:
        discover_folder(found, package, folder, frozenset())
    entries = [_entry(cls) for cls in found.modules]
    if values.json:
        echo(json.dumps([asdict(entry) for entry in entries], indent=1))
    else:
        for entry in entries:
            echo(entry.path)
    print_problems(found.problems)
    if found.problems:
        raise CliError(f"correct them first; {MANIFEST_FILE} is unchanged", code="module_broken")
    if not entries and not values.json:
        echo(
            f"no module class in {' or '.join(str(package.root / each) for each in MODULE_FOLDERS)}"
        )
    if values.write:
        write_manifest(package.root / MANIFEST_FILE, entries)
        if not values.json:
            echo(f"wrote {package.root / MANIFEST_FILE}")
    return 0


def package_at(start: Path) -> Application:
    """Return the package to work on: that of a cog or of an application.

    Raises NoApplicationError if there is neither, ConfigErrors for an invalid UpFile.
    """
    if (start / UP_FILE).is_file():
        return Application.at(start)
    inner = start / start.name.replace("-", "_")
    for folder in (start, inner, *sorted(path.parent for path in start.glob(f"*/{MANIFEST_FILE}"))):
        if (folder / f"{REGISTRANT_MODULE}.py").is_file():
            return _package(folder)
    if (start / "modules").is_dir():
        return _package(start)
    return Application.find(start)


def _package(folder: Path) -> Application:
    return Application(folder, folder.name.replace("-", "_"), folder / "config")


def _entry(cls: type[BaseModule]) -> ModuleEntry:
    return ModuleEntry(class_name=cls.__name__, prefix=cls.__module__)
