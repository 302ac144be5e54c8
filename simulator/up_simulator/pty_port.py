"""The serial line of the board: a pseudo terminal with a name that does not change."""

from __future__ import annotations

import errno
import fcntl
import os
import struct
import termios
import tty
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from twisted.internet.interfaces import IReadDescriptor
from zope.interface import implementer

UNREAD_MOST = 2048
READ_SIZE = 4096


class PtyLinkError(Exception):
    """The symbolic link cannot be made: the message is one sentence for the user."""


@implementer(IReadDescriptor)
class PtyPort:
    """A pty whose other end anybody may open, close and open again.

    ``write`` never blocks: when nobody reads, what waits is thrown away and the newest message
    alone waits instead, as a USB port without a listener does. Dropped messages are counted in
    ``dropped``. ``received`` gets bytes; ``returned`` is called when a reader came back.
    Raises ``PtyLinkError``.
    """

    def __init__(self, reactor: Any, link: Path | None = None) -> None:
        self._reactor = reactor
        self.received: Callable[[bytes], None] = lambda _data: None
        self.returned: Callable[[], None] = lambda: None
        self.dropped = 0
        self._is_unread = False
        self._link: Path | None = None
        # The other end stays open here, too: its raw mode then outlives every reader, and its
        # absence is no hang-up that would have to be polled.
        self._own, self._other = os.openpty()
        tty.setraw(self._other)
        os.set_blocking(self._own, False)
        self.name = os.ttyname(self._other)
        if link is not None:
            try:
                self._make_link(link)
            except PtyLinkError:
                self._close()
                raise
        reactor.addReader(self)

    @property
    def path(self) -> str:
        """Return where to open the board: the link if there is one."""
        return self.name if self._link is None else str(self._link)

    def fileno(self) -> int:
        """Return our end's descriptor, for the reactor."""
        return self._own

    def logPrefix(self) -> str:  # noqa: N802 - the reactor's name
        """Return what the reactor calls this in its log."""
        return "pty"

    def doRead(self) -> None:  # noqa: N802 - the reactor's name
        """Hand on what has come."""
        try:
            data = os.read(self._own, READ_SIZE)
        except BlockingIOError:
            return
        self._release()
        if data:
            self.received(data)

    def connectionLost(self, reason: object) -> None:  # noqa: N802 - the reactor's name
        """Take leave of the reactor, which is stopping."""

    def write(self, data: bytes) -> None:
        """Send bytes if somebody reads; drop them otherwise."""
        unread = self._unread()
        if self._is_unread and unread == 0:
            self._is_unread = False
            self.returned()
        elif self._is_unread or unread > UNREAD_MOST:
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
        """Remove the link and close the pty."""
        self._reactor.removeReader(self)
        if self._link is not None:
            with suppress(OSError):
                if str(self._link.readlink()) == self.name:
                    self._link.unlink()
        self._close()

    def _release(self) -> None:
        """Undo exclusive use: the last close would, but there is none while we hold the line."""
        fcntl.ioctl(self._other, termios.TIOCNXCL)

    def _close(self) -> None:
        os.close(self._own)
        os.close(self._other)

    def _unread(self) -> int:
        answer = fcntl.ioctl(self._other, termios.FIONREAD, struct.pack("i", 0))
        count: int = struct.unpack("i", answer)[0]
        return count

    def _make_link(self, link: Path) -> None:
        """Let ``link`` point here in one step; an old link is replaced, nothing else is."""
        if link.exists() and not link.is_symlink():
            raise PtyLinkError(f"{link} exists and is no symbolic link: left alone")
        temporary = link.with_name(f".{link.name}.{os.getpid()}")
        try:
            temporary.symlink_to(self.name)
            temporary.replace(link)
        except OSError as error:
            with suppress(OSError):
                temporary.unlink()
            raise PtyLinkError(f"cannot make the link {link}: {error.strerror}") from error
        self._link = link
