"""The pilot's stick inputs."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass

ALL_VALID = 0b111111


@dataclass(frozen=True, slots=True)
class RXCommand(BaseCommand):
    """The six receiver inputs in microseconds of pulse; ``valid`` has a bit for each, in order."""

    NAME = "up.rx.update"
    ROLES = frozenset({Role.BOARD})
    ailerons_us: int = value(key="ailerons", minimum=0, maximum=3000, unit="us")
    elevator_us: int = value(key="elevator", minimum=0, maximum=3000, unit="us")
    throttle_us: int = value(key="throttle", minimum=0, maximum=3000, unit="us")
    rudder_us: int = value(key="rudder", minimum=0, maximum=3000, unit="us")
    aux1_us: int = value(key="aux1", minimum=0, maximum=3000, unit="us")
    aux2_us: int = value(key="aux2", minimum=0, maximum=3000, unit="us")
    valid: int = value(minimum=0, maximum=ALL_VALID)
