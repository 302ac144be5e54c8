"""An application: a folder with an UpFile."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from pathlib import Path

from up.config import ConfigFile, key
from up.errors import UserError
from up.quick_dataclass import dataclass

UP_FILE = "UpFile"


@dataclass(frozen=True, slots=True)
class UpFileConfig:
    """Marks the folder of an application on Up."""

    package: str = key("", "The Python package that this folder is; empty: the folder's name.")
    config: str = key("config", "Where the configuration lies, from this folder.")


UP_FILE_CONFIG = ConfigFile(UP_FILE, UpFileConfig)


class NoApplicationError(UserError):
    """The search found no UpFile, or more than one; the text is one sentence."""


@dataclass(frozen=True, slots=True)
class Application:
    """The location of an application: its folder, its package, its configuration."""

    root: Path
    package: str
    config_folder: Path

    @classmethod
    def at(cls, root: Path) -> Application:
        """Return the application in a folder that has an UpFile; raises ConfigErrors."""
        values = UP_FILE_CONFIG.load(root)
        package = values.package or root.name.replace("-", "_")
        return cls(root, package, (root / values.config).resolve())

    @classmethod
    def find(cls, start: Path) -> Application:
        """Return the application that a folder belongs to.

        The UpFile is in that folder or one above it, or in exactly one direct subfolder. Raises
        NoApplicationError with a sentence that names the searched places.
        """
        start = start.resolve()
        for folder in (start, *start.parents):
            if (folder / UP_FILE).is_file():
                return cls.at(folder)
        inside = sorted(path.parent for path in start.glob(f"*/{UP_FILE}"))
        if len(inside) == 1:
            return cls.at(inside[0])
        if inside:
            names = ", ".join(folder.name for folder in inside)
            raise NoApplicationError(
                f"{start} holds several applications ({names}): go into one",
                code="several_applications",
                folder=start,
                applications=names,
            )
        raise NoApplicationError(
            f"no {UP_FILE} in {start}, above it or one folder below: not an application on Up"
            " (create one with: up create new -n NAME)",
            code="no_application",
            folder=start,
        )

    @classmethod
    def installed(cls, package: str) -> Application:
        """Return the application that an installed package is; raises NoApplicationError."""
        try:
            spec = importlib.util.find_spec(package) if package.isidentifier() else None
        except ValueError:
            spec = None
        for place in (spec and spec.submodule_search_locations) or ():
            if (Path(place) / UP_FILE).is_file():
                return cls.at(Path(place))
        text = f"no application {package[:80]!r} is installed in {sys.prefix}"
        raise NoApplicationError(text, code="not_installed", package=package)

    def make_importable(self) -> None:
        """Make ``import <package>`` find this folder, whatever its name and location."""
        known = sys.modules.get(self.package)
        if known is not None and self.root in map(Path, getattr(known, "__path__", ())):
            return
        try:
            found = importlib.util.find_spec(self.package)
        except (ImportError, ValueError):
            found = None
        places = list(found.submodule_search_locations or ()) if found else []
        if self.root in map(Path, places):
            return
        init = self.root / "__init__.py"
        spec = importlib.util.spec_from_file_location(
            self.package,
            init if init.is_file() else None,
            submodule_search_locations=[str(self.root)],
        )
        if spec is None:
            spec = importlib.machinery.ModuleSpec(self.package, None, is_package=True)
            spec.submodule_search_locations = [str(self.root)]
        module = importlib.util.module_from_spec(spec)
        for name in [n for n in sys.modules if n.split(".")[0] == self.package]:
            del sys.modules[name]
        sys.modules[self.package] = module
        if spec.loader is not None:
            spec.loader.exec_module(module)
