"""registered_modules.yml: the modules of a cog that an application loads (thesis 4.3.2)."""

from collections.abc import Iterable
from pathlib import Path

from up.cogs.cog import CogError
from up.config import ConfigFile, items
from up.config.atomic_writer import write_atomically
from up.loading.external_modules import ModuleEntry
from up.quick_dataclass import dataclass

MANIFEST_FILE = "registered_modules.yml"


@dataclass(frozen=True, slots=True)
class Manifest:
    """The classes of a cog that an application loads."""

    modules: tuple[ModuleEntry, ...] = items(ModuleEntry, "Classes that are loaded.")
    recorders: tuple[ModuleEntry, ...] = items(
        ModuleEntry, "Of old cogs; recorders became Thread Modules and are ignored."
    )


MANIFEST = ConfigFile(MANIFEST_FILE, Manifest)


def load_manifest(folder: Path, cog: str) -> Manifest:
    """Return the manifest in a cog's package folder.

    Raises CogError for a missing file, ConfigErrors with the place of every error.
    """
    if not (folder / MANIFEST_FILE).exists():
        raise CogError(
            f"the cog {cog} has no {MANIFEST_FILE} in {folder}: write it with 'up explore -w'",
            code="manifest_missing",
        )
    return MANIFEST.load(folder)


def write_manifest(path: Path, modules: Iterable[ModuleEntry]) -> None:
    """Write the manifest of a cog; raises OSError."""
    lines = ["# The classes that an application loads from this cog. 'up explore -w' writes it."]
    entries = list(entry_lines(modules, "  "))
    lines += ["modules:", *entries] if entries else ["modules: []"]
    write_atomically(path, ("\n".join(lines) + "\n").encode())


def entry_lines(modules: Iterable[ModuleEntry], indent: str) -> Iterable[str]:
    """Yield the YAML lines of a list of classes."""
    for module in modules:
        yield f"{indent}- class_name: {module.class_name}"
        yield f"{indent}  prefix: {module.prefix}"
