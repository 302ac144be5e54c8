"""The measured or required altitude of the aircraft."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class AltitudeCommand(BaseCommand):
    """An altitude above sea level, measured (``actual``) or asked for (``required``)."""

    NAME = "up.altitude.change"
    ROLES = frozenset({Role.SENSOR})
    ROLES_WHERE = {"mode": {"required": frozenset({Role.OPERATOR})}}
    altitude_m: float = value(key="altitude", minimum=-1000, maximum=30000, unit="m")
    mode: str = value("actual", choices=("actual", "required"))
