"""The servos' side of the pins: every edge at its cycle, and the pulses they make."""

from __future__ import annotations

import ctypes
import itertools
from dataclasses import dataclass

from up_rig.library import Handle


@dataclass(frozen=True, slots=True)
class Pulse:
    """One pulse at a servo: the cycle of its rise and how many cycles it lasted."""

    rise_cycle: int
    width_cycles: int

    @property
    def width_us(self) -> float:
        return self.width_cycles / 16


class Servo:
    """Records the pulses of the four servos; a pin that the chip does not drive is low."""

    def __init__(self, library: ctypes.CDLL, handle: Handle, pins: dict[str, int]) -> None:
        self._library = library
        self._handle = handle
        self._pins = pins
        self._edges: dict[int, list[tuple[int, int]]] = {}
        self._newest = library.rig_pulses(handle)

    def edges(self, channel: str) -> list[tuple[int, int]]:
        """Return (cycle, level) of every edge of a channel since the last ``clear``."""
        return list(self.pin_edges(self._pins[channel]))

    def pin_edges(self, pin: int) -> list[tuple[int, int]]:
        """Return (cycle, level) of every edge of any pin (port * 8 + bit), such as the LED's."""
        self._drain()
        return self._edges.get(pin, [])

    def pulses(self, channel: str) -> list[Pulse]:
        """Return the pulses of a channel that have ended since the last ``clear``."""
        edges = self.edges(channel)
        return [
            Pulse(rise, fall - rise)
            for (rise, is_high), (fall, is_still) in itertools.pairwise(edges)
            if is_high and not is_still
        ]

    def newest_us(self, channel: str) -> float | None:
        """Return the width of the newest pulse of a channel; None before the first."""
        pulses = self.pulses(channel)
        return pulses[-1].width_us if pulses else None

    def last_pulse(self, channel: str) -> Pulse | None:
        """Return the newest pulse of a channel that has ended, cleared or not."""
        newest = self._newest[self._pins[channel]]
        fall = newest.fall
        return Pulse(newest.rise, fall - newest.rise) if fall else None

    def record(self, is_recording: bool) -> None:
        """Record edges, or keep only ``last_pulse``."""
        self._library.rig_drop_edges(self._handle, not is_recording)

    def clear(self) -> None:
        """Discard all edges but the ones of pulses that are still high."""
        self._drain()
        for edges in self._edges.values():
            del edges[: -1 if edges and edges[-1][1] else None]

    def _drain(self) -> None:
        count = ctypes.c_uint64()
        recorded = self._library.rig_edges(self._handle, ctypes.byref(count))
        for at in range(count.value):
            edge = recorded[at]
            self._edges.setdefault(edge.pin, []).append((edge.cycle, edge.level))
        self._library.rig_clear_edges(self._handle)
