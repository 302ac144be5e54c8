"""The phone's battery."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role


@dataclass(frozen=True, slots=True)
class AndroidBatteryCommand(BaseCommand):
    """The level of the phone's battery (thesis 3.3.5): without it, its sensors and uplink go."""

    NAME: ClassVar[str] = "android.battery"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.SENSOR})
    level_percent: float = value(key="level", minimum=0, maximum=100, unit="percent")


@dataclass(frozen=True, slots=True)
class AndroidBatteryLowCommand(BaseCommand):
    """The event that the phone's battery became low or recovered; bus only."""

    NAME: ClassVar[str] = "android.battery.low"
    level_percent: float = value(key="level", minimum=0, maximum=100, unit="percent")
    low: bool = value()
