"""The phone's battery, and text for its voice."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class AndroidBatteryCommand(BaseCommand):
    """The level of the phone's battery (thesis 3.3.5): without it, its sensors and uplink go."""

    NAME = "android.battery"
    ROLES = frozenset({Role.SENSOR})
    level_percent: float = value(key="level", minimum=0, maximum=100, unit="percent")


@dataclass(frozen=True, slots=True)
class AndroidBatteryLowCommand(BaseCommand):
    """The event that the phone's battery became low or recovered; bus only."""

    NAME = "android.battery.low"
    level_percent: float = value(key="level", minimum=0, maximum=100, unit="percent")
    low: bool = value()


@dataclass(frozen=True, slots=True)
class AndroidSpeakCommand(BaseCommand):
    """Text for the phone's voice; carried to the phone, which answers it."""

    NAME = "android.speak"
    TITLE = 'Speak "{}"'
    ROLES = frozenset({Role.OPERATOR})
    ROUTE = "android"
    text: str = value(max_length=200)

    def __post_init__(self) -> None:
        if not self.text:
            raise ValueError("text must have 1 to 200 characters")
