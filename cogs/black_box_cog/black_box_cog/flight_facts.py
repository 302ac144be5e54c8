"""What is known of a flight before it begins: who flies, by which program and configuration."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from up.version import VERSION

_FILES_LIMIT = 64
_FILE_LIMIT_BYTES = 256 * 1024


@dataclass(frozen=True, slots=True)
class FlightFacts:
    """The words of a flight, and where the rest is found when the flight begins.

    ``packages`` are the top-level packages whose versions are of interest.
    """

    aircraft: str
    words: Mapping[str, str] = field(default_factory=dict)
    packages: tuple[str, ...] = ()
    config_folder: Path | None = None

    def flight(self, started: str) -> dict[str, str]:
        """Return the metadata record ``flight``."""
        return {
            "aircraft": self.aircraft,
            "version": VERSION,
            "started": started,
            "host": os.uname().nodename,
            "python": sys.version.split()[0],
            **self.words,
        }

    def versions(self) -> dict[str, str]:
        """Return the metadata record ``versions``: of Up and of every cog."""
        found = {"up": VERSION}
        for package in sorted({*self.packages} - {*found}):
            found[package] = version_of(package)
        return found

    def config_files(self) -> list[tuple[str, bytes]]:
        """Return the configuration as it is now; a file that cannot be read is left out."""
        return list(_read_all(self.config_folder)) if self.config_folder is not None else []


def version_of(package: str) -> str:
    """Return the version of the distribution that an imported package came with, or ''.

    Read from the metadata beside it, as importlib.metadata would take more memory than all else.
    """
    origin = getattr(sys.modules.get(package), "__file__", None)
    if origin is None:
        return ""
    # What is installed editable has its metadata elsewhere on the path.
    for place in (Path(origin).resolve().parent.parent, *map(Path, sys.path)):
        version = _versions_in(place).get(package)
        if version is not None:
            return version
    return ""


@cache
def _versions_in(place: Path) -> dict[str, str]:
    """Return the versions of the packages whose metadata lie in a folder; read once."""
    found: dict[str, str] = {}
    for pattern, name in (("*.egg-info", "PKG-INFO"), ("*.dist-info", "METADATA")):
        for folder in place.glob(pattern):
            packages = _text(folder / "top_level.txt").split()
            if packages:
                found |= dict.fromkeys(packages, _field(_text(folder / name), "Version"))
    return found


def _field(text: str, name: str) -> str:
    head = f"{name}: "
    return next((line[len(head) :] for line in text.splitlines() if line.startswith(head)), "")


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def _read_all(folder: Path) -> Iterable[tuple[str, bytes]]:
    try:
        paths = sorted(folder.glob("*.yml"))[:_FILES_LIMIT]
    except OSError:
        return
    for path in paths:
        try:
            if path.is_file() and path.stat().st_size <= _FILE_LIMIT_BYTES:
                yield path.name, path.read_bytes()
        except OSError:
            continue
