"""The flight mode and authority that the board reports."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role


@dataclass(frozen=True, slots=True)
class FlightStateCommand(BaseCommand):
    """The flight mode that acts, whether the motor is armed, whether the switch is at AUTO.

    ``is_in_flight`` is None while the board does not say enough to know.
    """

    NAME: ClassVar[str] = "up.flight.state"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.BOARD})
    flight_mode: str | None = value(max_length=16)
    is_armed: bool = value(key="armed")
    is_auto: bool = value(key="auto")
    is_failsafe: bool = value(key="failsafe")
    is_in_flight: bool | None = value(None, key="in_flight")
