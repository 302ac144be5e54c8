"""Up: a modular framework for autopilots that can be changed.

The public names, for applications and cogs, are those of ``up.public``; ``docs/api.md`` describes
them. They are imported on first use, because programs such as the proxy use only parts of the
package.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from up.public import *  # noqa: F403


def __getattr__(name: str) -> Any:
    public = import_module("up.public")
    if name not in ("__all__", *public.__all__):
        raise AttributeError(f"module 'up' has no attribute {name!r}")
    found = globals()[name] = getattr(public, name)
    return found


class _Package(ModuleType):
    def __setattr__(self, name: str, value: Any) -> None:
        # The import of the module `up.needs` must not replace the public function.
        if not (name == "needs" and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
