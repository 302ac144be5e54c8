"""The flight modes as a ground station lists and selects them (the standard modes protocol)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from struct import Struct
from typing import Any
from zlib import crc32

from up.flight_log.json_message import value_at
from up.flight_modes.declarations import AUTO, BOARD_MODES
from up.telemetry_frame import Frame
from up_mavlink.personas import GENERIC, PX4, UNKNOWN_MODE, Persona

AVAILABLE, CURRENT, MONITOR = "AVAILABLE_MODES", "CURRENT_MODE", "AVAILABLE_MODES_MONITOR"
NUMBERS = {435: AVAILABLE, 436: CURRENT, 437: MONITOR}
_CRC_EXTRA = {435: 134, 436: 193, 437: 30}
_AVAILABLE, _CURRENT, _MONITOR = Struct("<IIBBB35s"), Struct("<IIB"), Struct("<B")
NOT_SELECTABLE = 2
"""The bit of MAV_MODE_PROPERTY."""
MAX_MODES = 100
_FIRST, _SLOTS = 1 << 15, 1 << 15
"""Numbers of modes that the autopilot of a persona lacks: exact as REAL32, and above all others."""


@dataclass(frozen=True, slots=True)
class Packed:
    """A message that the dialect common lacks, with its payload; packs as pymavlink's do."""

    m: Any
    number: int
    payload: bytes

    def pack(self, mav: Any) -> bytes:
        message = self.m.MAVLink_message(self.number, NUMBERS[self.number])
        return bytes(message._pack(mav, _CRC_EXTRA[self.number], self.payload))


def modes_of(frame: Frame) -> dict[str, bool]:
    """Return the flight modes by name, and whether a ground may select each now.

    Those that only the switch or a fallback selects follow, for their names. AUTO, which stands for
    another mode, is left out: it is ArduPlane's name for a mission. Empty without such telemetry.
    """
    offers = value_at(frame.content, ("flight_control", "modes"))
    board = frame.texts("flight_control", "board_modes")
    if not isinstance(offers, Mapping) or board is None:
        return {}
    found = {str(name): why_not is None for name, why_not in sorted(offers.items())}
    found.update(dict.fromkeys(board, True))
    found.pop(AUTO, None)
    shown = (*BOARD_MODES, frame.text("flight_control", "selected"), frame.mode)
    for name in filter(None, shown):
        if name != AUTO:
            found.setdefault(name, False)
    return dict(list(found.items())[:MAX_MODES])


def numbers_of(persona: Persona, frame: Frame) -> dict[str, int]:
    """Return the custom mode of each flight mode; one that the persona lacks gets its own.

    That depends on the name alone, unless two names would have the same number. Empty for the
    persona generic.
    """
    if persona.name == GENERIC:
        return {}
    found: dict[str, int] = {}
    taken = set(persona.numbers.values())
    for name in modes_of(frame):
        number = persona.numbers.get(name)
        if number is None:
            number = next(each for each in _own_numbers(name, persona) if each not in taken)
            taken.add(number)
        found[name] = number
    return found


def _own_numbers(name: str, persona: Persona) -> Iterator[int]:
    first = crc32(name.encode())
    for step in range(_SLOTS):
        number = _FIRST + (first + step) % _SLOTS
        # PX4: a main mode above 127 in bits 16 to 23, a sub mode above it; the rest is 0.
        yield (number >> 8) << 16 | (number & 255) << 24 if persona.name == PX4 else number


def number_of(persona: Persona, frame: Frame, mode: str) -> int:
    """Return the custom mode of a flight mode; that of an unknown one if telemetry has none."""
    unknown = persona.numbers.get(UNKNOWN_MODE, 0)
    return {**persona.numbers, **numbers_of(persona, frame)}.get(mode, unknown)


def mode_of(persona: Persona, frame: Frame, number: int) -> str | None:
    """Return the flight mode that a custom mode selects; None: the aircraft has none."""
    known = (name for name, each in numbers_of(persona, frame).items() if each == number)
    return next(known, None) or persona.mode_of(number)


def current_mode(m: Any, frame: Frame, persona: Persona) -> Packed | None:
    """Return CURRENT_MODE: the mode that acts, and the selected one (0: none of the Pi's)."""
    if not frame.mode:
        return None
    selected = frame.text("flight_control", "selected")
    intended = 0 if not selected else number_of(persona, frame, selected)
    return Packed(m, 436, _CURRENT.pack(number_of(persona, frame, frame.mode), intended, 0))


class ModeList:
    """The list of one endpoint; ``sequence`` changes with it, modulo 256."""

    def __init__(self, persona: Persona) -> None:
        self._persona = persona
        self._known: list[tuple[str, int, bool]] = []
        self._sequence: int | None = None

    def update(self, frame: Frame) -> None:
        offered = modes_of(frame)
        numbers = numbers_of(self._persona, frame)
        present = [(name, number, offered[name]) for name, number in numbers.items()]
        if not present or present == self._known:
            return
        # A program that was restarted begins elsewhere: its list may be another one.
        begin = crc32(repr(present).encode()) if self._sequence is None else self._sequence + 1
        self._known, self._sequence = present, begin % 256

    def monitor(self, m: Any) -> Packed | None:
        """Return AVAILABLE_MODES_MONITOR; None without a list."""
        return None if self._sequence is None else Packed(m, 437, _MONITOR.pack(self._sequence))

    def messages(self, m: Any, index: int) -> list[Packed]:
        """Return AVAILABLE_MODES of one mode, from 1, or of all for 0; none: no such mode.

        Every mode is a non-standard one, so that a ground station shows our name.
        """
        chosen = list(enumerate(self._known, 1))
        if index:
            chosen = chosen[index - 1 : index] if index > 0 else []
        return [self._message(m, place, *mode) for place, mode in chosen]

    def _message(self, m: Any, place: int, name: str, number: int, is_offered: bool) -> Packed:
        properties, count = 0 if is_offered else NOT_SELECTABLE, len(self._known)
        text = name.encode("ascii", "replace")[:34]
        return Packed(m, 435, _AVAILABLE.pack(number, properties, count, place, 0, text))
