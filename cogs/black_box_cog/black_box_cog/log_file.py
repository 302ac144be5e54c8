"""A file that accepts whole records or none."""

import contextlib
from pathlib import Path

from black_box_cog.disk import Disk


class LogFile:
    """Collects records and writes them together; a partial write is truncated.

    After an OSError of ``flush`` or ``sync`` the file holds only whole records, as far as the disk
    accepted them, and must be closed. ``size`` is their length, ``lost`` how many did not fit.
    """

    def __init__(self, disk: Disk, path: Path, descriptor: int) -> None:
        self.path = path
        self.size = 0
        self.lost = 0
        self.is_synced = True
        self._disk = disk
        self._descriptor = descriptor
        self._records: list[bytes] = []

    def put(self, record: bytes) -> None:
        self._records.append(record)

    def flush(self) -> None:
        records, self._records = self._records, []
        if not records:
            return
        self.is_synced = False
        data = memoryview(b"".join(records))
        written = 0
        try:
            while written < len(data):
                written += self._disk.write(self._descriptor, data[written:])
        except OSError:
            self._keep_whole(records, written)
            raise
        self.size += written

    def sync(self) -> None:
        """Wait until the written data are on the disk; raises OSError."""
        self._disk.sync(self._descriptor)
        self.is_synced = True

    @property
    def is_linked(self) -> bool:
        """Return whether the file still has a name; raises OSError."""
        return self._disk.is_linked(self._descriptor)

    def close(self) -> None:
        descriptor, self._descriptor = self._descriptor, -1
        if descriptor >= 0:
            with contextlib.suppress(OSError):
                self._disk.close(descriptor)

    def _keep_whole(self, records: list[bytes], written: int) -> None:
        whole = 0
        for number, record in enumerate(records):
            if whole + len(record) > written:
                self.lost = len(records) - number
                break
            whole += len(record)
        self.size += whole
        # If this fails too, a reader finds half a record at the end and stops there.
        with contextlib.suppress(OSError):
            self._disk.truncate(self._descriptor, self.size)
