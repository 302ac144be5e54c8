"""disabled_modules.yml: the modules that stay out."""

from __future__ import annotations

from dataclasses import dataclass

from up.config.file import ConfigFile
from up.config.schema import items
from up.fields import Constraint


@dataclass(frozen=True, slots=True)
class DisabledModulesConfig:
    """Modules that are not loaded, built-in ones included."""

    disabled_modules: tuple[str, ...] = items(
        Constraint(str, max_length=255),
        "Full names, like package.modules.altitude.AltitudeModule, one a line after a dash.",
        name="disabled modules",
    )


DISABLED_MODULES = ConfigFile("disabled_modules.yml", DisabledModulesConfig)
