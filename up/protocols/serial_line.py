"""The serial line as a transport of the reactor; it reopens after a fault."""

import os
from collections import deque
from collections.abc import Callable, Hashable
from typing import Any, Protocol

from twisted.internet.defer import Deferred, succeed
from twisted.internet.interfaces import IReadWriteDescriptor
from twisted.internet.main import CONNECTION_LOST
from twisted.internet.task import deferLater
from twisted.python.failure import Failure
from zope.interface import implementer

from up.protocols.serial_port import close_serial
from up.quick_dataclass import dataclass
from up.system.clock import Timer, cancel

INITIAL_DELAY_S = 0.2
MAX_DELAY_S = 1.6
"""Between attempts to open; below the 2 s within which a restored line is used again."""

PENDING_LIMIT = 1024
LAST_FRAME_S = 0.1
"""For a last frame, and what waits before it, at 115200 baud."""
_READ_SIZE = 65536
_UNPLUGGED = "the port was unplugged or closed by the other side"


class SerialLike(Protocol):
    """A port opened elsewhere, such as pyserial's."""

    def fileno(self) -> int:
        """Return the descriptor."""

    def close(self) -> object:
        """Close the port."""


@dataclass(slots=True)
class SerialLineCounters:
    """Counts of opens and losses, and of frames that were not sent."""

    opened: int = 0
    lost: int = 0
    dropped: int = 0
    replaced: int = 0


@implementer(IReadWriteDescriptor)
class SerialLine:
    """Opens a port, keeps it open and transfers bytes both ways, without a thread.

    `open_port` returns a non-blocking descriptor or an object that has one, and raises OSError with
    one sentence. Callbacks: `on_bytes(data)`, `on_opened()`, `on_lost(why)` for an open port that
    failed, `on_open_failed(why)` for each new reason why it cannot be opened.

    A frame is written immediately when none waits before it. Commands wait in order, up to
    `pending_limit` bytes; of each stream only the newest frame waits.
    """

    def __init__(
        self,
        reactor: Any,
        open_port: Callable[[], int | SerialLike],
        *,
        on_bytes: Callable[[bytes], object],
        on_opened: Callable[[], object],
        on_lost: Callable[[str], object],
        on_open_failed: Callable[[str], object] | None = None,
        pending_limit: int = PENDING_LIMIT,
    ) -> None:
        self.counters = SerialLineCounters()
        self.last_error = ""
        self.is_open = False
        self._reactor = reactor
        self._open_port = open_port
        self._on_bytes = on_bytes
        self._on_opened = on_opened
        self._on_lost = on_lost
        self._on_open_failed = on_open_failed
        self._pending_limit = pending_limit
        self._port: int | SerialLike | None = None
        self._number = -1
        self._timer: Timer | None = None
        self._failing: Timer | None = None
        self._delay_s = INITIAL_DELAY_S
        self._is_started = False
        self._why_lost = _UNPLUGGED
        self._rest = b""
        self._frames: deque[bytes] = deque()
        self._frames_size = 0
        self._newest: dict[Hashable, bytes] = {}
        self._is_writing = False

    def start(self) -> bool:
        """Try to open the port, and retry until it opens; return whether it is open already."""
        if not self._is_started:
            self._is_started = True
            self._delay_s = INITIAL_DELAY_S
            self._open()
        return self.is_open

    def stop(self) -> None:
        """Close the port immediately and keep it closed; does not call `on_lost`."""
        self._is_started = False
        cancel(self._timer)
        self._close()

    def end(self, frame: bytes) -> Deferred[None]:
        """Send a last frame, and close the port when it is out: closing discards unsent bytes."""
        if not self.write(frame):
            self.stop()
            return succeed(None)
        return deferLater(self._reactor, LAST_FRAME_S, self.stop)

    def write(self, frame: bytes) -> bool:
        """Send a frame in order; False: the line is closed or stuck, the frame dropped, counted."""
        if not self.is_open or self._frames_size + len(frame) > self._pending_limit:
            self.counters.dropped += 1
            return False
        if self._is_writing:
            self._frames.append(frame)
            self._frames_size += len(frame)
        else:
            self._write_now(frame)
        return True

    def write_newest(self, key: Hashable, frame: bytes) -> bool:
        """Send a frame that replaces a waiting one with the same `key`."""
        if not self.is_open:
            self.counters.dropped += 1
            return False
        if self._is_writing:
            # Removed first, so that waiting streams take turns in the order of their frames.
            self.counters.replaced += self._newest.pop(key, None) is not None
            self._newest[key] = frame
        else:
            self._write_now(frame)
        return True

    def reopen(self) -> None:
        """Close the port and reopen it, as after a fault."""
        if self.is_open:
            self._lost("reopening")

    def fileno(self) -> int:
        return self._number

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
        # Only received bytes prove the port: one that opens and then fails is retried slowly.
        self._delay_s = INITIAL_DELAY_S
        self._on_bytes(data)
        return None

    def doWrite(self) -> Exception | None:  # noqa: N802 - Twisted's name
        while self.is_open:
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

    def connectionLost(self, reason: Failure | None) -> None:  # noqa: N802 - Twisted's name
        if self.is_open:
            self._lost(self._why_lost)

    def _open(self) -> None:
        try:
            self._port = self._open_port()
        except OSError as error:
            self._fail(str(error))
            return
        self._number = self._port if isinstance(self._port, int) else self._port.fileno()
        os.set_blocking(self._number, False)
        self.is_open = True
        self.last_error = ""
        self._why_lost = _UNPLUGGED
        self.counters.opened += 1
        self._reactor.addReader(self)
        self._on_opened()

    def _fail(self, why: str) -> None:
        is_news = why != self.last_error
        self.last_error = why
        self._try_again()
        if is_news and self._on_open_failed is not None:
            self._on_open_failed(why)

    def _failed(self, error: OSError) -> Exception:
        self._why_lost = f"the port failed: {os.strerror(error.errno or 0)}"
        return CONNECTION_LOST

    def _lost(self, why: str) -> None:
        self._close()
        self.counters.lost += 1
        self.last_error = why
        if self._is_started:
            self._try_again()
        self._on_lost(why)

    def _try_again(self) -> None:
        self._timer = self._reactor.callLater(self._delay_s, self._open)
        self._delay_s = min(self._delay_s * 2, MAX_DELAY_S)

    def _close(self) -> None:
        """Leave the reactor and close the port; no more reads, writes or callbacks."""
        if not self.is_open:
            return
        self.is_open = False
        cancel(self._failing)
        self._reactor.removeReader(self)
        self._reactor.removeWriter(self)
        self._discard_waiting()
        port, self._port, self._number = self._port, None, -1
        if isinstance(port, int):
            close_serial(port)
        elif port is not None:
            port.close()

    def _write_now(self, frame: bytes) -> None:
        try:
            written = os.write(self._number, frame)
        except BlockingIOError:
            written = 0
        except OSError as error:
            # Reported later, like a read fault: never from inside the caller's write.
            self._failed(error)
            self._is_writing = True
            self._failing = self._reactor.callLater(0, self.connectionLost, None)
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

    def _discard_waiting(self) -> None:
        self._rest = b""
        self._frames.clear()
        self._frames_size = 0
        self._newest.clear()
        self._is_writing = False
