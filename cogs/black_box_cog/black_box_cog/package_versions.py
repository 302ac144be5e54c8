"""The versions of the installed packages.

Read from the metadata beside the packages, as importlib.metadata would take more memory than the
rest of the recorder.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

_METADATA = (("*.egg-info", "PKG-INFO"), ("*.dist-info", "METADATA"))
_known: dict[Path, dict[str, str]] = {}


def version_of(package: str) -> str:
    """Return the version of the distribution of an imported package, or ''."""
    for _ in look_for(package):
        pass
    places = (_known.get(place, {}) for place in _places(package))
    return next((found[package] for found in places if package in found), "")


def look_for(package: str) -> Iterator[None]:
    """Read the metadata of an imported package, in pieces; each folder is read once."""
    for place in _places(package):
        if place not in _known:
            yield from _read(place)
        if package in _known[place]:
            return


def _places(package: str) -> tuple[Path, ...]:
    origin = getattr(sys.modules.get(package), "__file__", None)
    if origin is None:
        return ()
    # An editable installation has its metadata elsewhere on the path.
    return (Path(origin).resolve().parent.parent, *map(Path, sys.path))


def _read(place: Path) -> Iterator[None]:
    found: dict[str, str] = {}
    for pattern, name in _METADATA:
        for folder in place.glob(pattern):
            packages = _text(folder / "top_level.txt").split()
            if packages:
                found |= dict.fromkeys(packages, _field(_text(folder / name), "Version"))
            yield
    _known[place] = found


def _field(text: str, name: str) -> str:
    head = f"{name}: "
    return next((line[len(head) :] for line in text.splitlines() if line.startswith(head)), "")


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
