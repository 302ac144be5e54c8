"""One open serial port in the reactor: reads large pieces, writes each frame immediately."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Hashable
from typing import Any

from twisted.internet.interfaces import IReadWriteDescriptor
from twisted.internet.main import CONNECTION_LOST
from twisted.python.failure import Failure
from zope.interface import implementer

_READ_SIZE = 65536


@implementer(IReadWriteDescriptor)
class SerialDescriptor:
    """Transfers bytes from and to one descriptor until it fails; then reports the failure, once.

    A frame is written immediately when none waits before it. Commands wait in order, up to
    `pending_limit` bytes; of each stream only the newest frame waits. The creator of the descriptor
    owns and closes it.
    """

    def __init__(
        self,
        reactor: Any,
        number: int,
        *,
        on_bytes: Callable[[bytes], object],
        on_lost: Callable[[str], object],
        pending_limit: int,
    ) -> None:
        self._reactor = reactor
        self._number = number
        self.on_bytes = on_bytes
        self._on_lost = on_lost
        self._pending_limit = pending_limit
        self._rest = b""
        self._frames: deque[bytes] = deque()
        self._frames_size = 0
        self._newest: dict[Hashable, bytes] = {}
        self._is_writing = False
        self._is_stopped = False
        self._why_lost = "the port was unplugged or closed by the other side"

    def start(self) -> None:
        self._reactor.addReader(self)

    def stop(self) -> None:
        """Leave the reactor; no more reads, writes or callbacks."""
        if not self._is_stopped:
            self._is_stopped = True
            self._reactor.removeReader(self)
            self._reactor.removeWriter(self)

    def write(self, frame: bytes) -> bool:
        """Write or queue a frame; False if the queue is full and the frame was not accepted."""
        if not self._is_writing:
            self._write_now(frame)
            return True
        if self._frames_size + len(frame) > self._pending_limit:
            return False
        self._frames.append(frame)
        self._frames_size += len(frame)
        return True

    def write_newest(self, key: Hashable, frame: bytes) -> bool:
        """Write a frame, or keep it as the newest of `key`; True if it replaced an older one."""
        if not self._is_writing:
            self._write_now(frame)
            return False
        # Removed first, so that waiting streams take turns in the order of their frames.
        is_replacing = self._newest.pop(key, None) is not None
        self._newest[key] = frame
        return is_replacing

    def fileno(self) -> int:
        """Return the descriptor; -1 after `stop`."""
        return -1 if self._is_stopped else self._number

    def logPrefix(self) -> str:  # noqa: N802 - Twisted's name
        return "serial"

    def doRead(self) -> Exception | None:  # noqa: N802 - Twisted's name
        try:
            data = os.read(self._number, _READ_SIZE)
        except BlockingIOError:
            return None
        except OSError as error:
            return self._failed(error)
        if not data:
            return CONNECTION_LOST
        self.on_bytes(data)
        return None

    def doWrite(self) -> Exception | None:  # noqa: N802 - Twisted's name
        while not self._is_stopped:
            if not self._rest:
                self._rest = self._pop_next()
                if not self._rest:
                    self._is_writing = False
                    self._reactor.removeWriter(self)
                    break
            try:
                written = os.write(self._number, self._rest)
            except BlockingIOError:
                break
            except OSError as error:
                return self._failed(error)
            self._rest = self._rest[written:]
        return None

    def connectionLost(self, reason: Failure) -> None:  # noqa: N802 - Twisted's name
        if not self._is_stopped:
            self.stop()
            self._on_lost(self._why_lost)

    def _write_now(self, frame: bytes) -> None:
        try:
            written = os.write(self._number, frame)
        except BlockingIOError:
            written = 0
        except OSError as error:
            # Reported later, like a read fault: never from inside the caller's write.
            self._failed(error)
            self._is_writing = True
            self._reactor.callLater(0, self.connectionLost, None)
            return
        if written < len(frame):
            self._rest = frame[written:]
            self._is_writing = True
            self._reactor.addWriter(self)

    def _pop_next(self) -> bytes:
        if self._frames:
            frame = self._frames.popleft()
            self._frames_size -= len(frame)
            return frame
        if self._newest:
            return self._newest.pop(next(iter(self._newest)))
        return b""

    def _failed(self, error: OSError) -> Exception:
        self._why_lost = f"the port failed: {os.strerror(error.errno or 0)}"
        return CONNECTION_LOST
