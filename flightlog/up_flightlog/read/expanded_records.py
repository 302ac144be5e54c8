"""The records of compressed chunks while their flight log is in use."""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from up.flight_log.mcap_format import FlightLogError

MAX_IN_MEMORY = 64 * 1024 * 1024
MAX_SIZE = 16 << 30
RESERVE = 400_000_000
"""Left free on the disk: more than a recorder keeps free there by deleting flights, by default."""
_FOLDER = Path("/var/tmp")
"""On the disk everywhere; /tmp may be in memory."""
_BUFFER = 1 << 20
_CHECKED = 16 * 1024 * 1024


class ExpandedRecords:
    """Up to 64 MiB in memory, more in a file without a name, in the folder that TMPDIR sets.

    The file ends with the object and with the program. ``size`` is where the next records come.
    """

    def __init__(self) -> None:
        self.size = 0
        self._memory = bytearray()
        self._file: BinaryIO | None = None
        self._folder = ""
        self._checked = 0

    def __del__(self) -> None:
        if self._file is not None:
            with contextlib.suppress(OSError):
                self._file.close()

    def append(self, records: bytes) -> None:
        """Append the records of a chunk; raises FlightLogError."""
        size = self.size + len(records)
        if size > MAX_SIZE:
            text = f"a compressed flight log has more than {MAX_SIZE >> 30} GiB of records"
            raise FlightLogError(f"{text}: split it with mcap's tools", "too_large")
        if size <= MAX_IN_MEMORY:
            self._memory += records
        else:
            with self._disk_errors():
                file = self._file or self._spill()
                if size > self._checked:
                    self._check_room(len(records))
                file.write(records)
        self.size = size

    def finish(self) -> None:
        """Make all of them readable, in other processes too; raises FlightLogError."""
        with self._disk_errors():
            if self._file is not None:
                self._file.flush()

    def read(self, offset: int, size: int) -> bytes:
        """Return as many bytes as there are; raises OSError."""
        if self._file is None:
            return bytes(self._memory[offset : offset + size])
        return os.pread(self._file.fileno(), size, offset)

    def _spill(self) -> BinaryIO:
        self._folder = os.environ.get("TMPDIR") or str(
            _FOLDER if os.access(_FOLDER, os.W_OK) else tempfile.gettempdir()
        )
        self._check_room(self.size)
        file: BinaryIO = tempfile.TemporaryFile(  # type: ignore[assignment]  # noqa: SIM115
            buffering=_BUFFER, dir=self._folder
        )
        file.write(self._memory)
        # From now on it is read.
        self._file, self._memory = file, bytearray()
        return file

    def _check_room(self, more: int) -> None:
        self._checked = self.size + _CHECKED
        if shutil.disk_usage(self._folder).free < RESERVE + _CHECKED + more:
            megabytes = RESERVE // 1_000_000
            text = f"fewer than {megabytes} MB would remain free (TMPDIR sets another folder)"
            raise FlightLogError(f"cannot expand a flight log in {self._folder}: {text}", "no_room")

    @contextlib.contextmanager
    def _disk_errors(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            text = f"cannot expand a flight log in {self._folder} (TMPDIR sets another folder)"
            raise FlightLogError(f"{text}: {error.strerror or error}", "no_room") from None
