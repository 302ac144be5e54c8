"""The roles of a link and their rights."""

from __future__ import annotations

from enum import Enum


class Role(Enum):
    """The rights of a link; a link's role is configuration, never part of a message."""

    SENSOR = "sensor"
    BOARD = "board"
    OBSERVER = "observer"
    OPERATOR = "operator"
    PILOT = "pilot"
    ADMIN = "admin"
    INTERNAL = "internal"

    @property
    def includes(self) -> frozenset[Role]:
        """Return the roles whose rights this role includes, itself among them."""
        return _INCLUDES[self]


_LADDER = (Role.OBSERVER, Role.OPERATOR, Role.PILOT, Role.ADMIN)
_INCLUDES = {
    **{role: frozenset(_LADDER[: place + 1]) for place, role in enumerate(_LADDER)},
    Role.SENSOR: frozenset({Role.SENSOR, Role.OBSERVER}),
    Role.BOARD: frozenset({Role.BOARD}),
    Role.INTERNAL: frozenset(Role),
}
