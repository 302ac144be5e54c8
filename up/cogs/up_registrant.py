"""The base of every cog's Registrant (thesis 4.3.2)."""

import inspect
from pathlib import Path
from typing import Any, ClassVar

from up.cogs.manifest import MANIFEST_FILE, Manifest, load_manifest
from up.cogs.registry import Registry, Source
from up.config import ConfigFile, write_template
from up.loading.application import Application
from up.output import echo


class UpRegistrant:
    """Integrates a cog into an application; extend it as ``Registrant`` in ``registrar.py``.

    It enters the modules that ``registered_modules.yml`` lists into the application's
    ``external_modules.yml`` and creates the configuration files that the cog reads.
    ``CONFIG_FILES`` names them; an existing file is never changed. Override ``prepare`` for
    anything else that the cog needs, such as data files.
    """

    CONFIG_FILES: ClassVar[tuple[ConfigFile[Any], ...]] = ()

    @property
    def cog_name(self) -> str:
        """Return the cog's package, which contains ``registrar.py``."""
        return type(self).__module__.rpartition(".")[0]

    @property
    def folder(self) -> Path:
        return Path(inspect.getfile(type(self))).resolve().parent

    @property
    def manifest(self) -> Manifest:
        """Return the cog's manifest; raises CogError or ConfigErrors."""
        return load_manifest(self.folder, self.cog_name)

    def register(self, application: Application, source: Source = "manual") -> bool:
        """Integrate the cog; return whether it was not integrated before.

        Raises CogError or ConfigErrors for errors that a user can fix, OSError for a failed write.
        """
        manifest = self.manifest
        if manifest.recorders:
            echo(
                f"{self.cog_name}: {MANIFEST_FILE} lists recorders; they are ignored, make them"
                " Thread Modules"
            )
        changed = Registry(application.root).add(self.cog_name, manifest.modules, source)
        echo_registered(self.cog_name, changed)
        self.create_configuration(application)
        self.prepare(application)
        return changed

    def create_configuration(self, application: Application) -> None:
        for file in self.CONFIG_FILES:
            if write_template(file, application.config_folder):
                path = application.config_folder / file.filename
                echo(f"{self.cog_name}: created {path}", "created", cog=self.cog_name, path=path)

    def prepare(self, application: Application) -> None:
        """Create everything else that the cog needs."""


def echo_registered(cog: str, changed: bool) -> None:
    """Show that a cog is registered, newly or as before."""
    text = f"{cog}: {'registered' if changed else 'is registered'}"
    echo(text, "cog_registered", cog=cog, changed=changed)
