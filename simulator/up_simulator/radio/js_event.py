"""The events of Linux's joystick interface (linux/joystick.h)."""

from __future__ import annotations

import struct
from dataclasses import dataclass

SIZE = 8
FULL = 32767
_BUTTON, _AXIS, _INIT = 0x01, 0x02, 0x80


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
        """Return the events that these bytes complete."""
        data = self._rest + data
        whole = len(data) - len(data) % SIZE
        self._rest = data[whole:]
        events: list[JsEvent] = []
        for _time, value, kind, number in struct.iter_unpack("=IhBB", data[:whole]):
            if kind & ~_INIT in (_BUTTON, _AXIS):
                events.append(JsEvent(number, value, kind & ~_INIT == _AXIS))
        return events
