"""All calls of the recorder to the operating system; each of them may block."""

import fcntl
import os
from pathlib import Path

_NEW = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC


class Disk:
    """The file system, for the recorder's thread only; the methods raise OSError."""

    def create(self, path: Path) -> int:
        """Create a new file and lock it, so that no other recorder deletes it."""
        descriptor = os.open(path, _NEW, 0o644)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            # Not every file system has locks; the file's name is unique anyway.
            return descriptor
        return descriptor

    def write(self, descriptor: int, data: memoryview) -> int:
        """Append data; return the number of bytes written."""
        return os.write(descriptor, data)

    def sync(self, descriptor: int) -> None:
        os.fdatasync(descriptor)

    def truncate(self, descriptor: int, size: int) -> None:
        os.ftruncate(descriptor, size)

    def is_linked(self, descriptor: int) -> bool:
        return os.fstat(descriptor).st_nlink > 0

    def close(self, descriptor: int) -> None:
        os.close(descriptor)

    def make_folder(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)

    def open_folder(self, folder: Path) -> int:
        return os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)

    def sync_folder(self, folder: Path) -> None:
        descriptor = self.open_folder(folder)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)

    def free_bytes(self, folder: Path) -> int:
        status = os.statvfs(folder)
        return status.f_bavail * status.f_frsize

    def size(self, path: Path) -> int:
        return path.stat().st_size

    def is_locked(self, path: Path) -> bool:
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
        """Delete a file; a missing one is not an error."""
        path.unlink(missing_ok=True)
