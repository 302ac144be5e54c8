"""The wiring of the board's pins (docs/wiring.md)."""

from __future__ import annotations

from dataclasses import dataclass

CHANNELS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
SERVOS = ("ailerons", "elevator", "throttle", "rudder")

_PORT_B, _PORT_C, _PORT_D = 0, 8, 16


def pin(name: str) -> int:
    """Return the chip's pin (port * 8 + bit) of a board's pin, such as ``D9`` or ``A4``."""
    number = int(name[1:])
    if name[0] == "A":
        return _PORT_C + number
    return _PORT_D + number if number < 8 else _PORT_B + number - 8


@dataclass(frozen=True, slots=True)
class PinMap:
    """The chip's pins of the receiver's channels and of the servos."""

    receiver: dict[str, int]
    servos: dict[str, int]


def _map(names: tuple[str, ...], pins: str) -> dict[str, int]:
    return dict(zip(names, map(pin, pins.split()), strict=True))


DEFAULT = PinMap(_map(CHANNELS, "D2 D4 D5 D6 D7 D8"), _map(SERVOS, "D9 D10 D3 D11"))
PROTOTYPE = PinMap(_map(CHANNELS, "D8 D9 D6 D10 D11 D12"), _map(SERVOS, "A3 A2 A1 A0"))
"""The board of the thesis (attachment 3)."""
