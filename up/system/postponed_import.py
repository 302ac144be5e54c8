"""Modules that are imported only when something of them is used.

Twisted imports ``http.cookiejar`` for its web client, and with it ``urllib.request``,
``http.client`` and ``email``: 31 modules, 2.7 MiB, an eighth of the reactor's import. No program
here uses them.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import Any


def postpone(name: str) -> None:
    """Let the first use of an attribute import the module ``name``, which is in a package."""
    if name in sys.modules:
        return
    package, _, own = name.rpartition(".")
    parent = import_module(package)
    module = ModuleType(name, "Not imported yet.")

    def load(attribute: str) -> Any:
        if attribute.startswith("__"):
            # Programs that look through sys.modules ask for these.
            raise AttributeError(attribute)
        if sys.modules.get(name) is module:
            del sys.modules[name]
        return getattr(import_module(name), attribute)

    module.__getattr__ = load  # type: ignore[method-assign]
    sys.modules[name] = module
    setattr(parent, own, module)
