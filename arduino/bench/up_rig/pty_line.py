"""The serial line as a pseudo terminal, which anybody may open, close and open again."""

from __future__ import annotations

import errno
import fcntl
import os
import select
import struct
import termios
import tty
from contextlib import suppress
from pathlib import Path

UNREAD_MOST = 2048


class PtyLineError(Exception):
    """The symbolic link cannot be made: the message is one sentence for the user."""


class PtyLine:
    """Bytes to and from whoever opens ``path``; nobody reading means that they are dropped.

    Raises ``PtyLineError``.
    """

    def __init__(self, link: Path | None = None) -> None:
        # The other end stays open here, too: its raw mode outlives every reader.
        self._own, self._other = os.openpty()
        tty.setraw(self._other)
        os.set_blocking(self._own, False)
        self._name = os.ttyname(self._other)
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
        return self._name if self._link is None else str(self._link)

    def read(self, timeout_s: float, most: int) -> bytes:
        """Return what has come, waiting for it up to a time."""
        if not select.select([self._own] if most > 0 else [], [], [], max(timeout_s, 0.0))[0]:
            return b""
        # The last close would end an exclusive use, but there is none while this end holds it.
        fcntl.ioctl(self._other, termios.TIOCNXCL)
        try:
            return os.read(self._own, most)
        except BlockingIOError:
            return b""

    def write(self, data: bytes) -> None:
        """Send bytes; what nobody has read is thrown away when it becomes too much."""
        unread: int = struct.unpack("i", fcntl.ioctl(self._other, termios.FIONREAD, bytes(4)))[0]
        if unread > UNREAD_MOST:
            termios.tcflush(self._other, termios.TCIFLUSH)
        try:
            os.write(self._own, data)
        except OSError as error:
            if error.errno not in (errno.EAGAIN, errno.EIO):
                raise

    def close(self) -> None:
        """Remove the link and close the line."""
        if self._link is not None:
            with suppress(OSError):
                if str(self._link.readlink()) == self._name:
                    self._link.unlink()
        os.close(self._own)
        os.close(self._other)

    def _make_link(self, link: Path) -> None:
        if link.exists() and not link.is_symlink():
            raise PtyLineError(f"{link} exists and is no symbolic link: left alone")
        temporary = link.with_name(f".{link.name}.{os.getpid()}")
        try:
            temporary.symlink_to(self._name)
            temporary.replace(link)
        except OSError as error:
            raise PtyLineError(f"cannot make the link {link}: {error.strerror}") from error
        self._link = link
