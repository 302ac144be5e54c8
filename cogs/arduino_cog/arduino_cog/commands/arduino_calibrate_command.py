"""Calibrating the Arduino from the ground."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role

CALIBRATIONS = {"level": 0, "receiver_begin": 1, "receiver_end": 2, "gyro": 3}


@dataclass(frozen=True, slots=True)
class ArduinoCalibrateCommand(BaseCommand):
    """Calibrates the disarmed Arduino: level and gyro while the aircraft stands still and level.

    Between receiver_begin and receiver_end all sticks and switches are moved to both ends and left
    in the middle.
    """

    NAME: ClassVar[str] = "arduino.calibrate"
    TITLE: ClassVar[str] = "Calibrate {}"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.PILOT})
    what: str = value(choices=tuple(CALIBRATIONS))
