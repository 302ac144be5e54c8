"""The servo positions."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class ServoCommand(BaseCommand):
    """The four servo outputs that the board drives now, in microseconds of pulse."""

    NAME = "up.servo.update"
    ROLES = frozenset({Role.BOARD})
    ailerons_us: int = value(key="ailerons", minimum=0, maximum=3000, unit="us")
    elevator_us: int = value(key="elevator", minimum=0, maximum=3000, unit="us")
    throttle_us: int = value(key="throttle", minimum=0, maximum=3000, unit="us")
    rudder_us: int = value(key="rudder", minimum=0, maximum=3000, unit="us")
