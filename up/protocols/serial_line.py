"""The serial line as a transport of the reactor; it reopens after a fault."""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from typing import Any, Protocol

from up.protocols.serial_descriptor import SerialDescriptor
from up.protocols.serial_port import close_serial
from up.system.clock import Timer, cancel

INITIAL_DELAY_S = 0.2
MAX_DELAY_S = 1.6
"""Between attempts to open; below the 2 s within which a restored line is used again."""

PENDING_LIMIT = 1024


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


class SerialLine:
    """Opens a port, keeps it open and transfers bytes both ways, without a thread.

    `open_port` returns a non-blocking descriptor or an object that has one, and raises OSError with
    one sentence. Callbacks: `on_bytes(data)`, `on_opened()`, `on_lost(why)` for an open port that
    failed, `on_open_failed(why)` for each new reason why it cannot be opened.
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
        self._reactor = reactor
        self._open_port = open_port
        self._on_bytes = on_bytes
        self._on_opened = on_opened
        self._on_lost = on_lost
        self._on_open_failed = on_open_failed
        self._pending_limit = pending_limit
        self._port: int | SerialLike | None = None
        self._descriptor: SerialDescriptor | None = None
        self._timer: Timer | None = None
        self._delay_s = INITIAL_DELAY_S
        self._is_started = False

    @property
    def is_open(self) -> bool:
        return self._descriptor is not None

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
        if self._descriptor is not None:
            self._descriptor.stop()
            self._close()

    def write(self, frame: bytes) -> bool:
        """Send a frame in order; False: the line is closed or stuck, the frame dropped, counted."""
        if self._descriptor is not None and self._descriptor.write(frame):
            return True
        self.counters.dropped += 1
        return False

    def write_newest(self, key: Hashable, frame: bytes) -> bool:
        """Send a frame that replaces a waiting one with the same `key`."""
        if self._descriptor is None:
            self.counters.dropped += 1
            return False
        if self._descriptor.write_newest(key, frame):
            self.counters.replaced += 1
        return True

    def reopen(self) -> None:
        """Close the port and reopen it, as after a fault."""
        if self._descriptor is not None:
            self._descriptor.stop()
            self._lost("reopening")

    def _open(self) -> None:
        try:
            self._port = self._open_port()
        except OSError as error:
            self._fail(str(error))
            return
        number = self._port if isinstance(self._port, int) else self._port.fileno()
        os.set_blocking(number, False)
        self._descriptor = SerialDescriptor(
            self._reactor,
            number,
            on_bytes=self._on_first_bytes,
            on_lost=self._lost,
            pending_limit=self._pending_limit,
        )
        self.last_error = ""
        self.counters.opened += 1
        self._descriptor.start()
        self._on_opened()

    def _fail(self, why: str) -> None:
        is_news = why != self.last_error
        self.last_error = why
        self._try_again()
        if is_news and self._on_open_failed is not None:
            self._on_open_failed(why)

    def _on_first_bytes(self, data: bytes) -> None:
        # Only received bytes prove the port: one that opens and then fails is retried slowly.
        self._delay_s = INITIAL_DELAY_S
        if self._descriptor is not None:
            self._descriptor.on_bytes = self._on_bytes
        self._on_bytes(data)

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
        port, self._port, self._descriptor = self._port, None, None
        if isinstance(port, int):
            close_serial(port)
        elif port is not None:
            port.close()
