"""The serial line as a pseudo terminal, which programs may open and close repeatedly."""

from __future__ import annotations

import errno
import fcntl
import os
import select
import struct
import termios
import tty
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from up_rig.errors import RigError

MAX_UNREAD_BYTES = 2048


class PtyLineError(RigError):
    """The symbolic link cannot be made."""


class PtyLine:
    """Bytes to and from the reader of ``path``; neither direction ever blocks.

    Without a reader the queue is dropped and only the newest piece is kept, as on a USB port
    without a listener: a new reader gets no old data. ``dropped`` counts the pieces, ``returned``
    is called when there is a reader again. Raises ``PtyLineError``.
    """

    def __init__(self, link: Path | None = None) -> None:
        self.returned: Callable[[], None] = lambda: None
        self.dropped = 0
        self._is_unread = False
        # The other end stays open here, too: its raw mode outlives every reader, and a missing
        # reader does not raise a hang-up that would have to be polled.
        self._own, self._other = os.openpty()
        tty.setraw(self._other)
        # A lock of the process, not of the file as a serial port's user takes it (flock).
        fcntl.lockf(self._other, fcntl.LOCK_EX | fcntl.LOCK_NB)
        os.set_blocking(self._own, False)
        self.name = os.ttyname(self._other)
        self._link: Path | None = None
        if link is not None:
            try:
                self._make_link(link)
            except PtyLineError:
                self.close()
                raise

    @property
    def path(self) -> str:
        """Return where to open it: the link if there is one."""
        return self.name if self._link is None else str(self._link)

    def read(self, timeout_s: float, most: int) -> bytes:
        """Return the received bytes, waiting for them up to a time."""
        if not select.select([self._own] if most > 0 else [], [], [], max(timeout_s, 0.0))[0]:
            return b""
        self._release()
        try:
            return os.read(self._own, most)
        except BlockingIOError:
            return b""

    def write(self, data: bytes) -> None:
        """Send bytes to a reader; drop them without one."""
        unread = self._unread()
        if self._is_unread and unread == 0:
            self._is_unread = False
            self.returned()
        elif self._is_unread or unread > MAX_UNREAD_BYTES:
            self._is_unread = True
            self.dropped += 1
            termios.tcflush(self._other, termios.TCIFLUSH)
            self._release()
        try:
            written = os.write(self._own, data)
        except OSError as error:
            if error.errno not in (errno.EAGAIN, errno.EIO):
                raise
            written = 0
        if written < len(data):
            self.dropped += 1

    def close(self) -> None:
        """Remove the link and close the line."""
        if self._link is not None:
            with suppress(OSError):
                if str(self._link.readlink()) == self.name:
                    self._link.unlink()
        os.close(self._own)
        os.close(self._other)

    def _release(self) -> None:
        """Undo exclusive use: only the last close would, and we hold the line open."""
        fcntl.ioctl(self._other, termios.TIOCNXCL)

    def _unread(self) -> int:
        count: int = struct.unpack("i", fcntl.ioctl(self._other, termios.FIONREAD, bytes(4)))[0]
        return count

    def _make_link(self, link: Path) -> None:
        """Point ``link`` here in one step; an old link is replaced, any other file is kept."""
        if link.exists() and not link.is_symlink():
            text = f"{link} exists and is not a symbolic link: left unchanged"
            raise PtyLineError(text, "not_a_link")
        if _is_live(link):
            text = f"{link} is the line of another board that runs: end it first"
            raise PtyLineError(text, "in_use")
        temporary = link.with_name(f".{link.name}.{os.getpid()}")
        try:
            temporary.symlink_to(self.name)
            temporary.replace(link)
        except OSError as error:
            with suppress(OSError):
                temporary.unlink()
            text = f"cannot make the link {link}: {error.strerror}"
            raise PtyLineError(text, "no_link") from error
        self._link = link


def _is_live(link: Path) -> bool:
    """Return whether a link leads to the pty of a ``PtyLine`` of another process."""
    try:
        descriptor = os.open(link, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    except OSError as error:
        return error.errno == errno.EBUSY
    try:
        fcntl.lockf(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return True
    finally:
        os.close(descriptor)
    return False
