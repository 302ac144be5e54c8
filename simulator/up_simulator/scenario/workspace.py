"""A flight's temporary folder, removed with the flight, or after a kill by a later one."""

from __future__ import annotations

import fcntl
import os
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path

PREFIX = "up-sim-"
LOCK = "lock"


class Workspace:
    """A folder held by a lock while this process lives, however the process ends.

    After ``kill -9`` only a later flight can remove the folder: it removes every folder of this
    kind, of the same user, whose lock is free.
    """

    def __init__(self) -> None:
        _sweep()
        # The folder is also removed when the last reference to it goes.
        self._temporary = tempfile.TemporaryDirectory(prefix=PREFIX, ignore_cleanup_errors=True)
        self.path = Path(self._temporary.name)
        # It is locked before it gets its name, so that no other process finds it free.
        fresh = self.path / f"{LOCK}.new"
        self._lock = fresh.open("w")
        fcntl.flock(self._lock, fcntl.LOCK_EX)
        fresh.rename(self.path / LOCK)

    def close(self) -> None:
        self._temporary.cleanup()
        self._lock.close()


def _sweep() -> None:
    """Remove the folders of killed flights, as far as possible."""
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        with suppress(OSError):
            if folder.is_symlink() or folder.stat().st_uid != os.getuid():
                continue
            with (folder / LOCK).open("r") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder, ignore_errors=True)
