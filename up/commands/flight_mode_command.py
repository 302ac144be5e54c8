"""The flight mode that the ground requests."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role


@dataclass(frozen=True, slots=True)
class FlightModeCommand(BaseCommand):
    """A flight mode; taken only while the pilot's switch stands at AUTO, and never ACRO."""

    NAME: ClassVar[str] = "up.flight_mode.set"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.OPERATOR})
    mode: str = value(choices=("RATE", "FBW", "AUTO"))
