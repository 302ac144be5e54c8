"""The phone's orientation, from one source at a time."""

from collections.abc import Callable
from dataclasses import asdict

from android_cog.phone_link import host_of
from up.protocols.orientation_forward import OrientationFrame
from up.protocols.orientation_server import (
    TAKEOVER_SILENCE_S,
    OrientationCounters,
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
        self._counters = OrientationCounters()
        self.factory = OrientationFactory(
            clock,
            on_orientation=self._on_stream_frame,
            on_connected=self._on_source_connected,
            on_lost=self._on_source_lost,
            permits=permits,
            counters=self._counters,
        )
        self.datagrams = OrientationDatagrams(
            clock,
            on_orientation=self._on_datagram_frame,
            on_connected=self._on_source_connected,
            on_lost=self._on_source_lost,
            permits=permits,
            counters=self._counters,
        )

    @property
    def connected(self) -> bool:
        return self._sources > 0

    @property
    def counters(self) -> dict[str, int]:
        """Return frames, dropped frames, replaced sources, frames of others and excess frames."""
        return {f"orientation_{name}": count for name, count in asdict(self._counters).items()}

    def recheck(self) -> None:
        """Drop the sources that are not permitted now."""
        if self.factory.source and not self._permits(host_of(self.factory.source)):
            self.factory.close()
        if self.datagrams.source and not self._permits(host_of(self.datagrams.source)):
            self.datagrams.drop("another phone is connected")

    def close(self) -> None:
        self.factory.close()

    def _on_stream_frame(self, frame: OrientationFrame, source: str) -> None:
        self._stream_rx_s = self._clock.seconds()
        self._on_frame(frame)

    def _on_datagram_frame(self, frame: OrientationFrame, source: str) -> None:
        rx_s = self._stream_rx_s
        if rx_s is not None and self._clock.seconds() - rx_s <= TAKEOVER_SILENCE_S:
            self._counters.frames -= 1
            self._counters.foreign += 1
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
