"""Commands to the Arduino: its calibrations and its profile."""

from __future__ import annotations

from typing import Any

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.flight_controller.profile_wire import Profile, nested
from up.quick_dataclass import dataclass

CALIBRATIONS = {"level": 0, "receiver_begin": 1, "receiver_end": 2, "gyro": 3}
MAX_V = 65.0


@dataclass(frozen=True, slots=True)
class ArduinoCalibrateCommand(BaseCommand):
    """Calibrates the disarmed Arduino: level and gyro while the aircraft stands still and level.

    Between receiver_begin and receiver_end all sticks and switches are moved to both ends and left
    in the middle.
    """

    NAME = "arduino.calibrate"
    TITLE = "Calibrate {}"
    ROLES = frozenset({Role.PILOT})
    what: str = value(choices=tuple(CALIBRATIONS))


@dataclass(frozen=True, slots=True)
class BatteryCalibrateCommand(BaseCommand):
    """Tells the disarmed Arduino the voltage of the flight battery, measured with a meter now.

    0: the battery is not wired to the Arduino.
    """

    NAME = "up.battery.calibrate"
    TITLE = "Flight battery has {} V"
    ROLES = frozenset({Role.PILOT})
    voltage: float = value(unit="V", minimum=0, maximum=MAX_V)


@dataclass(frozen=True, slots=True)
class ArduinoProfileRequestCommand(BaseCommand):
    """Requests the active profile of the Arduino."""

    NAME = "arduino.profile.request"
    TITLE = "Request the profile"
    ROLES = frozenset({Role.OBSERVER})


@dataclass(frozen=True, slots=True)
class ArduinoProfileValuesCommand(BaseCommand):
    """The active profile, with the keys of airframe.yml."""

    NAME = "arduino.profile.values"
    profile: dict[str, Any] = value()

    @classmethod
    def of(cls, profile: Profile) -> ArduinoProfileValuesCommand:
        return cls(nested(profile))

    @property
    def data(self) -> dict[str, Any]:
        """Return the profile itself, without an outer key."""
        return self.profile
