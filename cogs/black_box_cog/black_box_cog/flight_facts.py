"""The metadata of a flight, known before it begins: aircraft, program, configuration."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from black_box_cog.package_versions import look_for, version_of
from up.version import VERSION

_FILES_LIMIT = 64
_FILE_LIMIT_BYTES = 256 * 1024


@dataclass(frozen=True, slots=True)
class FlightFacts:
    """The metadata of a flight; versions and configuration are read when it begins.

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

    def prepare(self) -> Iterator[None]:
        """Read the versions in advance, in pieces."""
        for package in self.packages:
            yield from look_for(package)

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
