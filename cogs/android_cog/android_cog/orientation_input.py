"""The phone's orientation, from one source at a time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.internet.interfaces import IAddress
from twisted.internet.protocol import Protocol

from android_cog.phone_link import host_of
from up.protocols.orientation_forward import OrientationFrame
from up.protocols.orientation_server import (
    TAKEOVER_SILENCE_S,
    OrientationDatagrams,
    OrientationFactory,
)
from up.system.clock import Clock


class OrientationInput:
    """One TCP connection, and UDP while no TCP connection delivered a frame for 1 s.

    ``permits`` checks a source's host. ``on_connected`` and ``on_lost`` report the arrival of the
    first source and the loss of the last one.
    """

    def __init__(
        self,
        clock: Clock,
        permits: Callable[[str], bool],
        *,
        on_frame: Callable[[OrientationFrame], object],
        on_connected: Callable[[], object],
        on_lost: Callable[[], object],
    ) -> None:
        self._clock = clock
        self._on_frame = on_frame
        self._on_connected = on_connected
        self._on_lost = on_lost
        self._sources = 0
        self._stream_rx_s: float | None = None
        self._permits = permits
        self.factory = _FilteredFactory(
            clock,
            permits,
            on_orientation=self._on_stream_frame,
            on_connected=self._on_source_connected,
            on_lost=self._on_source_lost,
        )
        self.datagrams = _FilteredDatagrams(
            clock,
            permits,
            on_orientation=self._on_datagram_frame,
            on_connected=self._on_source_connected,
            on_lost=self._on_source_lost,
        )

    @property
    def connected(self) -> bool:
        """Return whether there is a source."""
        return self._sources > 0

    @property
    def counters(self) -> dict[str, int]:
        """Return frames, dropped frames, replaced sources, frames of others and excess frames."""
        parts = (self.factory.counters, self.datagrams.counters)
        return {
            "orientation_frames": sum(part.frames for part in parts),
            "orientation_dropped": sum(part.dropped for part in parts),
            "orientation_replaced": sum(part.replaced for part in parts),
            "orientation_foreign": sum(part.foreign for part in parts),
            "orientation_too_many": sum(part.too_many for part in parts),
        }

    def recheck(self) -> None:
        """Drop the sources that are not permitted now."""
        if self.factory.source and not self._permits(host_of(self.factory.source)):
            self.factory.close()
        if self.datagrams.source and not self._permits(host_of(self.datagrams.source)):
            self.datagrams.drop("another phone is connected")

    def close(self) -> None:
        """Drop the source."""
        self.factory.close()

    def _on_stream_frame(self, frame: OrientationFrame, source: str) -> None:
        self._stream_rx_s = self._clock.seconds()
        self._on_frame(frame)

    def _on_datagram_frame(self, frame: OrientationFrame, source: str) -> None:
        rx_s = self._stream_rx_s
        if rx_s is not None and self._clock.seconds() - rx_s <= TAKEOVER_SILENCE_S:
            self.datagrams.counters.frames -= 1
            self.datagrams.counters.foreign += 1
        else:
            self._on_frame(frame)

    def _on_source_connected(self, source: str) -> None:
        self._sources += 1
        if self._sources == 1:
            self._on_connected()

    def _on_source_lost(self, source: str, why: str) -> None:
        self._sources -= 1
        if self._sources == 0:
            self._on_lost()


class _FilteredFactory(OrientationFactory):
    """Accepts connections only from permitted peers."""

    def __init__(self, clock: Clock, permits: Callable[[str], bool], **callbacks: Any) -> None:
        super().__init__(clock, **callbacks)
        self._permits = permits

    def buildProtocol(self, addr: IAddress | None) -> Protocol | None:  # type: ignore[override]  # noqa: N802 - Twisted's name
        if not self._permits(getattr(addr, "host", "")):
            return None
        return super().buildProtocol(addr)


class _FilteredDatagrams(OrientationDatagrams):
    """Accepts datagrams only from permitted peers."""

    def __init__(self, clock: Clock, permits: Callable[[str], bool], **callbacks: Any) -> None:
        super().__init__(clock, **callbacks)
        self._permits = permits

    def datagramReceived(self, datagram: bytes, addr: Any) -> None:  # noqa: N802 - Twisted's name
        if self._permits(addr[0]):
            super().datagramReceived(datagram, addr)
