"""Small applications on the disk, each with its own package name."""

from __future__ import annotations

import itertools
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from twisted.internet.task import Clock

from up.context import Context
from up.loading.application import Application
from up.loading.plan import Plan
from up.mode import Mode
from up.up_loader import UpLoader

_numbers = itertools.count()


def write_application(root: Path, files: dict[str, str], name: str = "") -> Application:
    """Write an application with an UpFile and these files; its package name is unique."""
    package = name or f"tested_application_{next(_numbers)}"
    root.mkdir(parents=True, exist_ok=True)
    (root / "UpFile").write_text(f"package: {package}\n")
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    return Application.at(root)


def plan_of(application: Application, mode: Mode = Mode.AUTO) -> Plan:
    """Return what would be loaded."""
    return UpLoader(application, context_of(application, mode)).plan()


def context_of(application: Application, mode: Mode = Mode.AUTO) -> Context:
    """Return a context in which nothing moves."""
    return Context(Clock(), mode, application.config_folder)


@contextmanager
def importable(folder: Path, *packages: str) -> Iterator[None]:
    """Let the packages in a folder be imported, and forget them afterwards."""
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        for name in list(sys.modules):
            if name.split(".")[0] in packages:
                del sys.modules[name]
