"""external_modules.yml: the modules of the registered cogs (thesis 4.3.2)."""

from collections.abc import Iterable
from typing import Literal

from up.config import items, key
from up.config.file import MapFile
from up.quick_dataclass import dataclass

EXTERNAL_MODULES_FILE = "external_modules.yml"


@dataclass(frozen=True, slots=True)
class ModuleEntry:
    """One class of a cog: its name and the module that it is imported from."""

    class_name: str = key("", "Name of the class.", max_length=200)
    prefix: str = key("", "Module that the class is imported from.", max_length=300)

    @property
    def path(self) -> str:
        return f"{self.prefix}.{self.class_name}"

    def problems(self) -> Iterable[tuple[str, str, str]]:
        if not self.class_name.isidentifier():
            yield "class_name", "must be the name of a class", "bad_format"
        if not all(part.isidentifier() for part in self.prefix.split(".")):
            what = "must be the name of a Python module, like my_cog.modules.my_module"
            yield "prefix", what, "bad_format"


@dataclass(frozen=True, slots=True)
class CogEntry:
    """What one cog brings."""

    modules: tuple[ModuleEntry, ...] = items(ModuleEntry, "Classes that are loaded.")
    source: Literal["cogfile", "manual"] = key("manual", "Who registered the cog.")
    recorders: tuple[ModuleEntry, ...] = items(
        ModuleEntry, "Of old cogs; recorders became Thread Modules and are ignored."
    )


EXTERNAL_MODULES = MapFile(EXTERNAL_MODULES_FILE, CogEntry)
