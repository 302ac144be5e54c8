"""The folder of the flights: numbers new ones and frees space."""

import contextlib
import fcntl
import os
from collections.abc import Iterator
from pathlib import Path

from black_box_cog.config import MEGABYTE
from black_box_cog.disk import Disk
from up.flight_log.flight_file import FlightFile, flight_files

_ATTEMPTS = 100


class NoRoomError(Exception):
    """The disk is too full, and no flight is left to delete; the text is one sentence."""


class FlightFolder:
    """Creates the files of flights, and deletes old ones; the methods raise OSError."""

    def __init__(self, disk: Disk, path: Path, total_bytes: float, keep_free_bytes: float) -> None:
        self.path = path
        self._disk = disk
        self._total_bytes = total_bytes
        self._keep_free_bytes = keep_free_bytes

    def create(self, start_unix_s: float, aircraft: str) -> tuple[FlightFile, int]:
        """Begin a flight with the next number; return its file and an open descriptor."""
        self._disk.make_folder(self.path)
        with self._locked():
            number = max((each.number for each in flight_files(self.path)), default=0)
            for _ in range(_ATTEMPTS):
                number += 1
                file = FlightFile.first(self.path, number, start_unix_s, aircraft)
                with contextlib.suppress(FileExistsError):
                    return file, self._disk.create(file.path)
        raise FileExistsError(f"no free number up to {number} in {self.path}")

    def create_part(self, last: FlightFile) -> tuple[FlightFile, int]:
        """Continue a flight in another file; return it and an open descriptor."""
        self._disk.make_folder(self.path)
        file = last
        for _ in range(_ATTEMPTS):
            file = file.at_part(file.part + 1)
            with contextlib.suppress(FileExistsError):
                return file, self._disk.create(file.path)
        raise FileExistsError(f"no free part up to {file.part} of {last.path}")

    def make_room(self, current: FlightFile | None = None) -> list[FlightFile]:
        """Delete the oldest flights until the rest fits, and return those deleted.

        Deletes whole flights, and the oldest parts of the current one, but never a file that a
        recorder still writes. Raises NoRoomError if the space is still too small.
        """
        self._disk.make_folder(self.path)
        files = flight_files(self.path)
        sizes = {file: self._size(file) for file in files}
        left = sum(sizes.values())
        deleted: list[FlightFile] = []
        for group in _oldest_first(files, current):
            if left <= self._total_bytes and self._is_free_enough():
                return deleted
            if any(file == current or self._disk.is_locked(file.path) for file in group):
                continue
            for file in group:
                self._disk.remove(file.path)
                left -= sizes[file]
            deleted += group
        if not self._is_free_enough():
            free_mb = self._disk.free_bytes(self.path) // MEGABYTE
            keep_mb = self._keep_free_bytes / MEGABYTE
            raise NoRoomError(
                f"{free_mb} MB are free in {self.path}, but {keep_mb:g} MB must stay free"
                " (black_box.yml: keep free (MB))"
            )
        return deleted

    def _is_free_enough(self) -> bool:
        return self._disk.free_bytes(self.path) >= self._keep_free_bytes

    def _size(self, file: FlightFile) -> int:
        try:
            return self._disk.size(file.path)
        except FileNotFoundError:
            return 0

    @contextlib.contextmanager
    def _locked(self) -> Iterator[None]:
        """Lock the folder while choosing a number: another daemon may do the same."""
        descriptor = self._disk.open_folder(self.path)
        try:
            # Without locks two flights may get one number; their names still differ.
            with contextlib.suppress(OSError):
                fcntl.flock(descriptor, fcntl.LOCK_EX)
            yield
        finally:
            os.close(descriptor)


def _oldest_first(
    files: list[FlightFile], current: FlightFile | None
) -> Iterator[list[FlightFile]]:
    """Yield the units of deletion: whole flights, then the parts of the current one."""
    flights: dict[tuple[int, str, str], list[FlightFile]] = {}
    for file in files:
        flights.setdefault(file.flight, []).append(file)
    own = [] if current is None else flights.pop(current.flight, [])
    yield from flights.values()
    yield from ([file] for file in own)
