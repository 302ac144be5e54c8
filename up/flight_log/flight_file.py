"""The name of a flight's file: number, start time, aircraft, part."""

from __future__ import annotations

import os
import re
import time
from pathlib import Path

from up.quick_dataclass import dataclass

_NAME = re.compile(
    r"(?P<number>[0-9]{4,9})-(?P<stamp>[0-9]{8}T[0-9]{6}Z)-(?P<aircraft>[A-Za-z0-9_-]{1,32})"
    r"(\.(?P<part>[2-9]|[1-9][0-9]{1,5}))?\.mcap",
    re.ASCII,
)
_NOT_IN_NAMES = re.compile(r"[^A-Za-z0-9_-]", re.ASCII)


@dataclass(frozen=True, slots=True)
class FlightFile:
    """One file: ``0007-20260814T093000Z-kite.mcap``, the second part ``...-kite.2.mcap``.

    Numbers increase, as a Raspberry Pi has no clock at boot; ``stamp`` is UTC as then known.
    """

    folder: Path
    number: int
    stamp: str
    aircraft: str
    part: int = 1

    @classmethod
    def of(cls, path: Path) -> FlightFile | None:
        """Parse a path; None if it does not name a flight's file."""
        found = _NAME.fullmatch(path.name)
        if found is None:
            return None
        part = int(found["part"] or 1)
        return cls(path.parent, int(found["number"]), found["stamp"], found["aircraft"], part)

    @classmethod
    def first(cls, folder: Path, number: int, start_unix_s: float, aircraft: str) -> FlightFile:
        """Return the first file of a flight; characters that a name may not hold become ``_``."""
        stamp = time.strftime("%Y%m%dT%H%M%SZ", time.gmtime(start_unix_s))
        return cls(folder, number, stamp, _NOT_IN_NAMES.sub("_", aircraft)[:32] or "default")

    @property
    def path(self) -> Path:
        part = "" if self.part == 1 else f".{self.part}"
        return self.folder / f"{self.number:04d}-{self.stamp}-{self.aircraft}{part}.mcap"

    @property
    def flight(self) -> tuple[int, str, str]:
        """Return the common name of a flight's parts."""
        return self.number, self.stamp, self.aircraft

    def at_part(self, part: int) -> FlightFile:
        return FlightFile(self.folder, self.number, self.stamp, self.aircraft, part)


def flight_files(folder: Path) -> list[FlightFile]:
    """Return the flight files in a folder, oldest first; raises OSError."""
    with os.scandir(folder) as entries:
        paths = [Path(each.path) for each in entries if each.is_file(follow_symlinks=False)]
    found = [each for each in map(FlightFile.of, paths) if each is not None]
    return sorted(found, key=lambda each: (each.number, each.stamp, each.aircraft, each.part))
