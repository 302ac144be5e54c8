"""Which autopilot an endpoint appears to be: ground stations interpret mode numbers by it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

ARDUPILOT, PX4, GENERIC = PERSONAS = ("ardupilot", "px4", "generic")
UNKNOWN_MODE = "unknown"
_PLANE = {
    "ACRO": 0, "CIRCLE": 1, "RATE": 4, "FBW": 5, "CRUISE": 7, "MISSION": 10, "RETURN": 11,
    "LOITER": 12, "TAKEOFF": 13, "GUIDED": 15, UNKNOWN_MODE: 16, "GLIDE": 24, "LAND": 26,
}  # fmt: skip
"""ArduPlane's numbers, where one of its modes is near ours; others get one in ``modes.py``."""


def _px4(main: int, sub: int = 0) -> int:
    return main << 16 | sub << 24


_PX4 = {
    "ACRO": _px4(1), "CIRCLE": _px4(2), "CRUISE": _px4(3), "TAKEOFF": _px4(4, 2),
    "LOITER": _px4(4, 3), "MISSION": _px4(4, 4), "RETURN": _px4(4, 5), "LAND": _px4(4, 6),
    "RATE": _px4(5), "GUIDED": _px4(6), "FBW": _px4(7),
    UNKNOWN_MODE: _px4(7),
}  # fmt: skip
# The first name of a number is the one that it selects.


@dataclass(frozen=True, slots=True)
class Persona:
    """An autopilot: its number in MAV_AUTOPILOT, and the numbers of the flight modes.

    ``has_home_item``: item 0 of a mission is home, and the mission begins at 1.
    """

    name: str
    autopilot: int
    numbers: Mapping[str, int] = field(default_factory=dict)
    has_home_item: bool = False

    def mode_of(self, number: int) -> str | None:
        """Return the flight mode of a custom mode; None: the aircraft has none."""
        found = (name for name, each in self.numbers.items() if each == number)
        name = next(found, None)
        return None if name == UNKNOWN_MODE else name


BY_NAME = {
    each.name: each
    for each in (
        Persona(ARDUPILOT, 3, _PLANE, has_home_item=True),
        Persona(PX4, 12, _PX4),
        Persona(GENERIC, 0),
    )
}
