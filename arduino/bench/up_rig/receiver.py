"""The RC receiver's six wires: pulses at exact cycles, and all their faults."""

from __future__ import annotations

import ctypes
import random
from dataclasses import dataclass

from up_rig.library import Handle

CYCLES_PER_US = 16
NEUTRAL_US = {
    "ailerons": 1500.0,
    "elevator": 1500.0,
    "throttle": 1000.0,
    "rudder": 1500.0,
    "aux1": 1000.0,
    "aux2": 1000.0,
}
_LOW, _HIGH = 0, 1


@dataclass(frozen=True, slots=True)
class SentPulse:
    """A pulse as it was put on a channel's wire."""

    channel: str
    rise_cycle: int
    width_cycles: int


class Receiver:
    """Sends frames of pulses, one for each channel, until it is stopped.

    ``period_us`` is the time of a frame (7 to 22 ms in the trade). ``is_simultaneous`` starts all
    channels together; otherwise each starts ``gap_us`` after the end of the one before.
    ``jitter_us`` disturbs each width, ``period_jitter_us`` each frame, both evenly to either side.
    Changes hold from the next frame on. ``sent`` lists the sent pulses.
    """

    def __init__(
        self, library: ctypes.CDLL, handle: Handle, pins: dict[str, int], seed: int = 1
    ) -> None:
        self._library = library
        self._handle = handle
        self._pins = pins
        self._random = random.Random(f"receiver {seed}")
        self._widths_us = dict(NEUTRAL_US)
        self._held: dict[str, int] = {}
        self._next_us = 0.0
        self.period_us = 20_000.0
        self.is_simultaneous = False
        self.gap_us = 10.0
        self.jitter_us = 0.0
        self.period_jitter_us = 0.0
        self.sent: list[SentPulse] = []
        self._is_on = False
        for channel in pins:
            self.edge(channel, 0, _LOW)

    def set(self, channel: str, width_us: float) -> None:
        """Set the pulse of a channel; any width is sent, also one that no stick gives."""
        if channel not in self._pins:
            raise KeyError(channel)
        self._widths_us[channel] = width_us

    def sticks(self, **widths_us: float) -> None:
        """Set several channels together: ``sticks(ailerons=1600, aux2=2000)``."""
        for channel, width_us in widths_us.items():
            self.set(channel, width_us)

    def start(self, at_us: float | None = None) -> None:
        """Begin to send frames, at a time or now; a stopped channel resumes."""
        now_us = self._library.rig_cycle(self._handle) / CYCLES_PER_US
        self._next_us = now_us if at_us is None else at_us
        for channel, level in self._held.items():
            if level == _HIGH:
                self.edge(channel, int(now_us * CYCLES_PER_US), _LOW)
        self._held.clear()
        self._is_on = True

    def stop(self, channel: str | None = None, *, level: int = _LOW) -> None:
        """Send no more pulses on a channel, or on all: it stays low, or rises and stays high."""
        for each in self._pins if channel is None else (channel,):
            self._held[each] = level
            if level == _HIGH and not self._is_on:
                self.edge(each, self._library.rig_cycle(self._handle), _HIGH)

    def resume(self, channel: str) -> None:
        if self._held.pop(channel, _LOW) == _HIGH:
            self.edge(channel, self._library.rig_cycle(self._handle), _LOW)

    def edge(self, channel: str, cycle: int, level: int) -> None:
        """Drive a channel's wire to a level at a cycle; level 2 releases it."""
        self._library.rig_pin_edge(self._handle, cycle, self._pins[channel], level)

    def level(self, channel: str) -> int:
        return int(self._library.rig_pin_level(self._handle, self._pins[channel]))

    def glitch(self, channel: str, at_us: float, width_us: float, *, level: int = _HIGH) -> None:
        """Add noise: the wire changes to a level at a time for a while, and back."""
        start = round(at_us * CYCLES_PER_US)
        self.edge(channel, start, level)
        self.edge(channel, start + max(1, round(width_us * CYCLES_PER_US)), 1 - level)

    def feed(self, until_cycle: int) -> None:
        """Put all frames on the wires that start until a cycle; the rig calls this."""
        while self._is_on and self._next_us * CYCLES_PER_US <= until_cycle:
            self._send_frame(self._next_us)
            self._next_us += self.period_us + self._spread(self.period_jitter_us)

    def _send_frame(self, start_us: float) -> None:
        at_us = start_us
        for channel in self._pins:
            width_us = max(0.1, self._widths_us[channel] + self._spread(self.jitter_us))
            rise = round(at_us * CYCLES_PER_US)
            width = round(width_us * CYCLES_PER_US)
            held = self._held.get(channel)
            if held != _LOW:
                self.edge(channel, rise, _HIGH)
            if held is None:
                self.edge(channel, rise + width, _LOW)
                self.sent.append(SentPulse(channel, rise, width))
            if not self.is_simultaneous:
                at_us += width_us + self.gap_us

    def _spread(self, most: float) -> float:
        return self._random.uniform(-most, most) if most else 0.0
