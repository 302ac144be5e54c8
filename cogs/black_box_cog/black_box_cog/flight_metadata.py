"""The metadata of a flight, known before it begins: aircraft, program, versions, configuration."""

import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from pathlib import Path

from up.quick_dataclass import dataclass
from up.version import VERSION

_FILES_LIMIT = 64
_FILE_LIMIT_BYTES = 256 * 1024
# importlib.metadata would take more memory than the rest of the recorder.
_METADATA = (("*.egg-info", "PKG-INFO"), ("*.dist-info", "METADATA"))
_known: dict[Path, dict[str, str]] = {}


@dataclass(frozen=True, slots=True)
class FlightMetadata:
    """The metadata of a flight; versions and configuration are read when it begins.

    ``packages`` are the top-level packages whose versions are of interest.
    """

    aircraft: str
    words: Mapping[str, str] = field(default_factory=dict)
    packages: tuple[str, ...] = ()
    config_folder: Path | None = None

    def flight(self, started: str) -> dict[str, str]:
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

    def prepare(self) -> Iterator[None]:
        """Read the versions in advance, in pieces."""
        for package in self.packages:
            yield from load_versions(package)

    def config_files(self) -> list[tuple[str, bytes]]:
        """Return the current configuration; a file that cannot be read is left out."""
        return list(_read_all(self.config_folder)) if self.config_folder is not None else []


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


def version_of(package: str) -> str:
    """Return the version of the distribution of an imported package, or ''."""
    for _ in load_versions(package):
        pass
    places = (_known.get(place, {}) for place in _places(package))
    return next((found[package] for found in places if package in found), "")


def load_versions(package: str) -> Iterator[None]:
    """Read the metadata of an imported package, in pieces; each folder is read once."""
    for place in _places(package):
        if place not in _known:
            yield from _read_metadata(place)
        if package in _known[place]:
            return


def _places(package: str) -> tuple[Path, ...]:
    origin = getattr(sys.modules.get(package), "__file__", None)
    if origin is None:
        return ()
    # An editable installation has its metadata elsewhere on the path.
    return (Path(origin).resolve().parent.parent, *map(Path, sys.path))


def _read_metadata(place: Path) -> Iterator[None]:
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
