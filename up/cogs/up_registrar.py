"""The base of the Registrars of cogs written for the prototype of Up.

New cogs extend ``up.cogs.up_registrant.UpRegistrant`` instead.
"""

import importlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from up.cogs.cog import CogError
from up.cogs.manifest import load_manifest
from up.cogs.registry import Registry, Source
from up.config.atomic_writer import create_text
from up.loading.application import Application
from up.loading.external_modules import EXTERNAL_MODULES_FILE as _FILE
from up.loading.external_modules import ModuleEntry
from up.output import echo


class UpRegistrar:
    """Registers a cog's modules and creates its configuration, with the prototype's interface.

    An old cog's ``Registrar`` overrides ``register`` and calls the methods below; it works on the
    application of the current folder.
    """

    EXTERNAL_MODULES_FILE = _FILE
    CONFIG_PATH = "config"

    def __init__(self, cog_name: str) -> None:
        self.cog_name = cog_name
        self.source: Source = "manual"
        self.changed = False
        self._modules: dict[ModuleEntry, None] = {}

    def register(self) -> bool:
        """Register the modules of the cog's manifest."""
        self._register_modules_from_file()
        return self._write_external_modules()

    def finish(self) -> bool:
        """Write the registration; return whether it changed."""
        registry = Registry(self._application.root)
        self.changed |= registry.add(self.cog_name, tuple(self._modules), self.source)
        return self.changed

    @property
    def _application(self) -> Application:
        return Application.find(Path.cwd())

    def _load_external_modules(self) -> Mapping[str, Any]:
        return Registry(self._application.root).entries()

    def _register_modules_from_file(self) -> bool:
        package = importlib.import_module(self.cog_name)
        if package.__file__ is None:
            raise CogError(f"the cog {self.cog_name} has no __init__.py", code="not_a_package")
        manifest = load_manifest(Path(package.__file__).parent, self.cog_name)
        for each in manifest.modules:
            self._register_module(each.class_name, each.prefix)
        if manifest.recorders:
            self._print_warning("recorders are ignored, make them Thread Modules")
        return True

    def _register_module(self, name: str, prefix: str) -> bool:
        self._modules[ModuleEntry(class_name=name, prefix=prefix)] = None
        return True

    def _write_external_modules(self, modules: object = None) -> bool:
        self.finish()
        return True

    def _create_config(self, name: str, content: str) -> bool:
        path = self._application.config_folder / name
        if create_text(path, content):
            self._print_info(f"created {path}")
        return True

    def _print_info(self, text: str) -> None:
        echo(f"{self.cog_name}: {text}")

    _print_ok = _print_success = _print_warning = _print_error = _print_critical = _print_info
