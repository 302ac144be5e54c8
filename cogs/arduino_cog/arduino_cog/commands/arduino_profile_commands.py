"""The profile of the airframe: requested and reported."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.flight_controller.profile_wire import Profile, nested


@dataclass(frozen=True, slots=True)
class ArduinoProfileRequestCommand(BaseCommand):
    """Requests the active profile of the Arduino."""

    NAME: ClassVar[str] = "arduino.profile.request"
    TITLE: ClassVar[str] = "Request the profile"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.OBSERVER})


@dataclass(frozen=True, slots=True)
class ArduinoProfileValuesCommand(BaseCommand):
    """The active profile, with the keys of airframe.yml."""

    NAME: ClassVar[str] = "arduino.profile.values"
    profile: dict[str, Any] = value()

    @classmethod
    def of(cls, profile: Profile) -> ArduinoProfileValuesCommand:
        return cls(nested(profile))

    @property
    def data(self) -> dict[str, Any]:
        """Return the profile itself, without an outer key."""
        return self.profile
