"""The PID file of a running program, and the signals that it ignores."""

import fcntl
import os
import signal
from collections.abc import Iterator, MutableMapping
from contextlib import contextmanager
from pathlib import Path

VARIABLE = "UP_PID_FILE"
"""Names the file; removed from the environment, as it belongs to one process."""


class PidFileHeld(Exception):  # noqa: N818 - the text is the message
    """Another process holds this file; `holder` is its PID."""

    def __init__(self, path: Path, holder: str) -> None:
        super().__init__(f"process {holder} runs already (pid file {path})")
        self.holder = holder


class PidFile:
    """Locked from `take` until `release` or the end of the process, however it ends.

    A file without a lock is stale and is overwritten.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._descriptor: int | None = None

    def take(self) -> None:
        """Write this process's PID; raises PidFileHeld and OSError."""
        flags = os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW
        while True:
            descriptor = os.open(self.path, flags, 0o644)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                holder = os.pread(descriptor, 32, 0).decode("ascii", "replace").strip()
                os.close(descriptor)
                raise PidFileHeld(self.path, holder) from None
            # The last holder removes the file before it unlocks it.
            if os.fstat(descriptor).st_nlink:
                break
            os.close(descriptor)
        try:
            os.ftruncate(descriptor, 0)
            os.pwrite(descriptor, f"{os.getpid()}\n".encode(), 0)
        except OSError:
            os.close(descriptor)
            raise
        self._descriptor = descriptor

    def release(self) -> None:
        descriptor, self._descriptor = self._descriptor, None
        if descriptor is not None:
            self.path.unlink(missing_ok=True)
            os.close(descriptor)


@contextmanager
def service(environ: MutableMapping[str, str] = os.environ) -> Iterator[None]:
    """Run a program's main: ignore SIGUSR1 and SIGUSR2, and hold the file that UP_PID_FILE names.

    Raises SystemExit with a sentence if the file cannot be held.
    """
    for number in (signal.SIGUSR1, signal.SIGUSR2):
        # A handler, not SIG_IGN, which child processes would inherit.
        signal.signal(number, lambda *_: None)
    path = environ.pop(VARIABLE, "")
    file = PidFile(Path(path).absolute())
    if path:
        try:
            file.take()
        except (PidFileHeld, OSError) as error:
            raise SystemExit(str(error)) from None
    try:
        yield
    finally:
        file.release()
