"""Everything that the recorder asks of the operating system; each of these calls may block."""

from __future__ import annotations

import fcntl
import os
from pathlib import Path

_NEW = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC


class Disk:
    """The file system, for the recorder's thread alone; the methods raise OSError."""

    def create(self, path: Path) -> int:
        """Open a file that is not there yet and hold it: whoever rotates leaves it alone."""
        descriptor = os.open(path, _NEW, 0o644)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            # Not every file system has locks; the file is ours by its name.
            return descriptor
        return descriptor

    def write(self, descriptor: int, data: memoryview) -> int:
        """Write at the end; return how many bytes went."""
        return os.write(descriptor, data)

    def sync(self, descriptor: int) -> None:
        """Wait until what was written is on the disk."""
        os.fdatasync(descriptor)

    def truncate(self, descriptor: int, size: int) -> None:
        """Cut the file."""
        os.ftruncate(descriptor, size)

    def is_linked(self, descriptor: int) -> bool:
        """Return whether the file has a name still."""
        return os.fstat(descriptor).st_nlink > 0

    def close(self, descriptor: int) -> None:
        """Close the file, and let go of it."""
        os.close(descriptor)

    def make_folder(self, folder: Path) -> None:
        """Make a folder with those above it."""
        folder.mkdir(parents=True, exist_ok=True)

    def open_folder(self, folder: Path) -> int:
        """Open a folder, to be synced or held."""
        return os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)

    def sync_folder(self, folder: Path) -> None:
        """Wait until the names in a folder are on the disk."""
        descriptor = self.open_folder(folder)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)

    def free_bytes(self, folder: Path) -> int:
        """Return what is free to this user."""
        status = os.statvfs(folder)
        return status.f_bavail * status.f_frsize

    def size(self, path: Path) -> int:
        """Return the size of a file."""
        return path.stat().st_size

    def is_held(self, path: Path) -> bool:
        """Return whether a recorder is writing the file."""
        try:
            descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
        except FileNotFoundError:
            return False
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:
            return False
        finally:
            os.close(descriptor)
        return False

    def remove(self, path: Path) -> None:
        """Delete a file; one that went already is no error."""
        path.unlink(missing_ok=True)
