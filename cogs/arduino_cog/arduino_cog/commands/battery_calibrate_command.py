"""Calibrating the measurement of the flight battery."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role

MAX_V = 65.0


@dataclass(frozen=True, slots=True)
class BatteryCalibrateCommand(BaseCommand):
    """Tells the disarmed Arduino the voltage of the flight battery, measured with a meter now.

    0: the battery is not wired to the Arduino.
    """

    NAME: ClassVar[str] = "up.battery.calibrate"
    TITLE: ClassVar[str] = "Flight battery has {} V"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.PILOT})
    voltage: float = value(unit="V", minimum=0, maximum=MAX_V)
