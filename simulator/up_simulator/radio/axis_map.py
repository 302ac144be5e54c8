"""Events of a game controller (linux/joystick.h), and which axis or button moves which channel."""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass, field

from up_simulator.radio.sticks import (
    CENTRE_US,
    CHANNELS,
    HIGHEST_US,
    LOWEST_US,
    SWITCH_US,
    RadioError,
    Sticks,
)

EVENT_SIZE = 8
FULL = 32767
_BUTTON, _AXIS, _INIT = 0x01, 0x02, 0x80
PRESETS = {
    "transmitter": "ailerons=0 elevator=1 throttle=2 rudder=3 aux1=4 aux2=5 dead=0.01",
    "gamepad": "rudder=0 throttle=1- ailerons=3 elevator=4 aux1=b5 aux2=b4 dead=0.08",
}
"""A radio on a USB cable (channels in the order AETR), and a game pad as Linux numbers it."""
MAX_DEAD = 0.5
MODES = tuple(SWITCH_US.values())
_SOURCE = re.compile(
    r"(?P<button>b?)(?P<number>\d{1,3})(?P<reversed>-?)"
    r"(?::(?P<low>-?\d{1,5})\.\.(?P<centre>-?\d{1,5})\.\.(?P<high>-?\d{1,5}))?"
)


@dataclass(frozen=True, slots=True)
class JsEvent:
    """A button (value 0 or 1) or an axis (value -32767 to 32767) at its number."""

    number: int
    value: int
    is_axis: bool


class JsEventReader:
    """Splits a stream of bytes into events; unknown kinds are dropped.

    An event is u32 time, i16 value, u8 kind, u8 number, in the machine's byte order. The state at
    the opening of a device arrives as events, too, and is treated the same way.
    """

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[JsEvent]:
        data = self._rest + data
        whole = len(data) - len(data) % EVENT_SIZE
        self._rest = data[whole:]
        events: list[JsEvent] = []
        for _time, value, kind, number in struct.iter_unpack("=IhBB", data[:whole]):
            if kind & ~_INIT in (_BUTTON, _AXIS):
                events.append(JsEvent(number, value, kind & ~_INIT == _AXIS))
        return events


@dataclass(frozen=True, slots=True)
class Source:
    """An axis (or button) and its conversion; ``low``, ``centre``, ``high`` calibrate it."""

    number: int
    is_axis: bool = True
    is_reversed: bool = False
    low: int = -FULL
    centre: int = 0
    high: int = FULL

    def pulse_us(self, value: int, dead: float) -> int:
        """Return the pulse of an axis at ``value``.

        ``dead`` is the fraction of the travel around the centre that has no effect.
        """
        way = self.high - self.centre if value >= self.centre else self.centre - self.low
        part = max(-1.0, min(1.0, (value - self.centre) / way))
        moved = max(0.0, (abs(part) - dead) / (1.0 - dead))
        signed = moved if (part < 0) == self.is_reversed else -moved
        return round(CENTRE_US + signed * (HIGHEST_US - CENTRE_US))


@dataclass(frozen=True, slots=True)
class AxisMap:
    """The sources of the channels, and the dead band (part of the way) around each centre."""

    sources: dict[str, Source] = field(default_factory=dict)
    dead: float = 0.0


def read_axis_map(text: str) -> AxisMap:
    """Return the map of a preset's name, or of a text such as ``ailerons=0 elevator=1- dead=0.05``.

    A source is an axis' number, ``-`` behind it reverses, ``b`` before it makes it a button: AUX1
    goes through its positions, other channels from end to end and back at every press.
    ``ailerons=0:-30000..120..31000`` calibrates. ``gamepad elevator=4-`` changes a preset. Raises
    ``RadioError``.
    """
    sources: dict[str, Source] = {}
    dead = 0.0
    words = text.replace(",", " ").split()
    if words and words[0] in PRESETS:
        words = PRESETS[words.pop(0)].split() + words
    for word in words:
        name, equals, value = word.partition("=")
        if equals and name == "dead":
            dead = _dead(value)
        elif equals and name in CHANNELS:
            sources[name] = _source(word, value)
        else:
            known = ", ".join((*PRESETS, *CHANNELS, "dead"))
            raise RadioError(f"controller map: {word!r} is not understood; known: {known}")
    if not sources:
        raise RadioError(f"controller map: no channel named (presets: {', '.join(PRESETS)})")
    return AxisMap(sources, dead)


class MappedSticks:
    """The sticks of a controller: its events in, pulses out."""

    def __init__(self, axis_map: AxisMap) -> None:
        self._map = axis_map
        self.now = Sticks(aux1=SWITCH_US["FBW"])

    def take(self, event: JsEvent) -> None:
        for channel, source in self._map.sources.items():
            if (source.number, source.is_axis) != (event.number, event.is_axis):
                continue
            if source.is_axis:
                pulse_us = source.pulse_us(event.value, self._map.dead)
                self.now = self.now.moved(channel, pulse_us)
            elif event.value:
                self.now = self.now.moved(channel, _next(channel, getattr(self.now, channel)))


def _next(channel: str, pulse_us: int) -> int:
    if channel == "aux1":
        nearest = min(MODES, key=lambda each: abs(each - pulse_us))
        return MODES[(MODES.index(nearest) + 1) % len(MODES)]
    return LOWEST_US if pulse_us > CENTRE_US else HIGHEST_US


def _dead(text: str) -> float:
    try:
        dead = float(text)
    except ValueError:
        dead = -1.0
    if not 0.0 <= dead <= MAX_DEAD:
        raise RadioError(f"controller map: dead={text} is not a part from 0 to {MAX_DEAD}")
    return dead


def _source(word: str, text: str) -> Source:
    found = _SOURCE.fullmatch(text) if text.isascii() else None
    if found is None or int(found["number"]) > 255:
        raise RadioError(f"controller map: {word!r} is not CHANNEL=NUMBER, =NUMBER- or =bNUMBER")
    if found["button"]:
        if found["reversed"] or found["low"]:
            raise RadioError(f"controller map: {word!r}: a button has no direction and no range")
        return Source(int(found["number"]), is_axis=False)
    if found["low"] is None:
        return Source(int(found["number"]), is_reversed=bool(found["reversed"]))
    low, centre, high = int(found["low"]), int(found["centre"]), int(found["high"])
    if not -FULL - 1 <= low < centre < high <= FULL:
        raise RadioError(f"controller map: {word!r}: LOW..CENTRE..HIGH rise from -32768 to {FULL}")
    return Source(int(found["number"]), True, bool(found["reversed"]), low, centre, high)
