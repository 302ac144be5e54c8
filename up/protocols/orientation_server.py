"""Receives orientation from a sensor, over TCP and UDP."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.internet.interfaces import IAddress
from twisted.internet.protocol import DatagramProtocol, Factory, Protocol, connectionDone
from twisted.python.failure import Failure

from up.protocols.orientation_forward import (
    OrientationDecoder,
    OrientationFrame,
    OrientationValues,
    decode_datagram,
)
from up.protocols.tcp_options import watch_peer, why_lost
from up.quick_dataclass import dataclass
from up.system.clock import Clock, Timer, cancel
from up.system.token_bucket import TokenBucket

TAKEOVER_SILENCE_S = 1.0
"""How long a source must be silent before another one may replace it."""
MAX_FRAMES_HZ = 500.0
MAX_BURST = 50
"""Frames of one source beyond its rate and burst are dropped."""

_USER_TIMEOUT_MS = 3000

OnOrientation = Callable[[OrientationFrame, str], object]
OnSource = Callable[[str], object]
OnSourceLost = Callable[[str, str], object]
Permits = Callable[[str], bool]


@dataclass(slots=True)
class OrientationCounters:
    """Counters of frames delivered and dropped, sources replaced and refused, and rate excess."""

    frames: int = 0
    dropped: int = 0
    replaced: int = 0
    foreign: int = 0
    too_many: int = 0


class _OrientationInput:
    """What the TCP and the UDP side have in common: the callbacks, the rate, the counters."""

    def __init__(
        self,
        clock: Clock,
        *,
        on_orientation: OnOrientation,
        on_connected: OnSource,
        on_lost: OnSourceLost,
        permits: Permits = lambda host: True,
        counters: OrientationCounters | None = None,
    ) -> None:
        self.counters = counters or OrientationCounters()
        self._permits = permits
        self._clock = clock
        self._bucket = TokenBucket(clock, MAX_FRAMES_HZ, MAX_BURST)
        self._heard_s = 0.0
        self._on_orientation = on_orientation
        self._on_connected = on_connected
        self._on_lost = on_lost

    def _deliver(self, frame: OrientationFrame, source: str) -> None:
        if self._bucket.take():
            self.counters.frames += 1
            self._on_orientation(frame, source)
        else:
            self.counters.too_many += 1


class OrientationFactory(_OrientationInput, Factory):
    """The TCP side: a connection is the source until it closes or is silent for 1 s.

    `on_orientation` gets a frame and the source as text, `on_connected` the source, `on_lost` the
    source and the reason. A replaced connection is reported as lost before the new one connects.
    `permits` returns whether a host may be a source.
    """

    noisy = False
    _current: _OrientationConnection | None = None

    @property
    def source(self) -> str:
        return "" if self._current is None else self._current.source

    def buildProtocol(self, addr: IAddress | None) -> Protocol | None:  # noqa: N802 - Twisted's name
        return _OrientationConnection(self) if self._permits(getattr(addr, "host", "")) else None

    def connected(self, connection: _OrientationConnection) -> None:
        """Make `connection` the source, or drop it while another one sends."""
        older, now_s = self._current, self._clock.seconds()
        if older is not None and now_s - self._heard_s <= TAKEOVER_SILENCE_S:
            self.counters.foreign += 1
            connection.drop()
            return
        if older is not None:
            self.counters.replaced += 1
            self.lost(older, f"silent for {TAKEOVER_SILENCE_S:g} s")
            older.drop()
        self._current, self._heard_s = connection, now_s
        self._on_connected(connection.source)

    def received(self, source: str, frames: list[OrientationValues]) -> None:
        """Deliver frames of the source, at most `MAX_FRAMES_HZ` and the newest of a burst."""
        self._heard_s = self._clock.seconds()
        self.counters.too_many += max(0, len(frames) - MAX_BURST)
        for values in frames[-MAX_BURST:]:
            self._deliver(OrientationFrame._make(values), source)

    def lost(self, connection: _OrientationConnection, why: str) -> None:
        if connection is self._current:
            self._current = None
            self._on_lost(connection.source, why)

    def close(self) -> None:
        if self._current is not None:
            self._current.drop()


class _OrientationConnection(Protocol):
    """One connection and its unfinished frame."""

    transport: Any

    def __init__(self, server: OrientationFactory) -> None:
        self.source = ""
        self._server = server
        self._decoder = OrientationDecoder()
        self._is_dropped = False

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        address = self.transport.getPeer()
        self.source = f"{address.host}:{address.port}"
        watch_peer(self.transport, _USER_TIMEOUT_MS)
        self._server.connected(self)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        dropped_before = self._decoder.dropped
        frames = self._decoder.feed(data)
        self._server.counters.dropped += self._decoder.dropped - dropped_before
        if frames and not self._is_dropped:
            self._server.received(self.source, frames)

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802 - Twisted's name
        self._server.lost(self, why_lost(reason))

    def drop(self) -> None:
        """Abort this connection; its remaining data are ignored."""
        self._is_dropped = True
        self.transport.abortConnection()


class OrientationDatagrams(_OrientationInput, DatagramProtocol):
    """The UDP side: the last address received from, until it is silent for 1 s.

    The callbacks are those of `OrientationFactory`. Only a valid frame makes or keeps a source.
    """

    noisy = False
    _address: Any = None
    _source = ""
    _timer: Timer | None = None

    def datagramReceived(self, datagram: bytes, addr: Any) -> None:  # noqa: N802 - Twisted's name
        if not self._permits(addr[0]):
            return
        if addr != self._address and self._address is not None:
            self._check_silence()
            if self._address is not None:
                self.counters.foreign += 1
                return
        frame = decode_datagram(datagram)
        if frame is None:
            self.counters.dropped += 1
            return
        self._heard_s = self._clock.seconds()
        if self._address is None:
            self._address = addr
            self._source = f"{addr[0]}:{addr[1]}"
            self._timer = self._clock.callLater(TAKEOVER_SILENCE_S, self._check_silence)
            self._on_connected(self._source)
        self._deliver(frame, self._source)

    @property
    def source(self) -> str:
        """Return host and port of the source; empty without one."""
        return "" if self._address is None else self._source

    def drop(self, why: str) -> None:
        self._lose(why)

    def stopProtocol(self) -> None:  # noqa: N802 - Twisted's name
        self._lose("the port was closed")

    def _check_silence(self) -> None:
        remaining = self._heard_s + TAKEOVER_SILENCE_S - self._clock.seconds()
        if remaining <= 0:
            self._lose(f"silent for {TAKEOVER_SILENCE_S:g} s")
        elif self._timer is None or not self._timer.active():
            self._timer = self._clock.callLater(remaining, self._check_silence)

    def _lose(self, why: str) -> None:
        cancel(self._timer)
        if self._address is not None:
            self._address = None
            self._on_lost(self._source, why)
