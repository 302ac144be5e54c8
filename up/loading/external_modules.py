"""external_modules.yml: which modules the registered cogs bring (thesis 4.3.2)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from up.config import items, key
from up.config.map_file import MapFile
from up.fields import Constraint

EXTERNAL_MODULES_FILE = "external_modules.yml"


@dataclass(frozen=True, slots=True)
class ModuleEntry:
    """One class of a cog: its name and the module that it is imported from."""

    class_name: str = key("", "Name of the class.", max_length=200)
    prefix: str = key("", "Module that the class is imported from.", max_length=300)

    @property
    def path(self) -> str:
        """Return the fully qualified name."""
        return f"{self.prefix}.{self.class_name}"


@dataclass(frozen=True, slots=True)
class CogEntry:
    """What one cog brings."""

    modules: tuple[ModuleEntry, ...] = items(ModuleEntry, "Classes that are loaded.")
    source: Literal["cogfile", "manual"] = key("manual", "Who registered the cog.")
    recorders: tuple[Any, ...] = items(
        Constraint(dict), "Of old cogs; recorders became Thread Modules and are ignored."
    )


EXTERNAL_MODULES = MapFile(EXTERNAL_MODULES_FILE, CogEntry)
